#include "command/command_line.hpp"

int main(int argc, char** argv) { return paperproof::compare::run_command_line(argc, argv); }
