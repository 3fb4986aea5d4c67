/// The command line of `paperproof`.
#pragma once

namespace paperproof::compare {

/// Runs the command. Takes over the standard streams and SIGPIPE of the process.
/// @return the exit status.
int run_command_line(int argc, char** argv);

}  // namespace paperproof::compare
