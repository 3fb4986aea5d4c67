// Writes the sample report to the path that is given: the browser check opens it.
#include "compare/sample_report.hpp"

#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: write_sample_report FILE.html\n", stderr);
    return 2;
  }
  try {
    paperproof::compare::write_report(argv[1], paperproof::compare::sample_report());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
