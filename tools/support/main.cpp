// SPDX-License-Identifier: MIT
// main() of all programs: options, exit codes, errors in one line, and failure if output is lost.
#include <fcntl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <splinertia/io/write_error.hpp>

#include "support/program.hpp"

namespace {

/// Makes lost output an error of the write. Without this, a closed pipe or a file that grows too large ends the program
/// with a signal, and a file that is opened while standard output is closed becomes the standard output.
void prepare_standard_streams() {
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    const bool closed = ::fcntl(stream, F_GETFD) == -1;
    // Opened in the direction that the stream does not use, so that its use fails. open() returns the lowest free
    // descriptor, which is that of the stream.
    if (closed) (void)::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

/// Parses the options and does the work.
void run(int argc, char** argv) {
  CLI::App app{this_program.description};
  const std::function<void()> work = this_program.set_up(app);
  try {
    app.parse(argc, argv);
    work();
  } catch (const CLI::ParseError& error) {
    if (app.exit(error) != 0) throw AlreadyReported(error.what());
  }
}

int fail(int code, const char* why) {
  std::fflush(stdout);
  std::fprintf(stderr, "%s: %s\n", this_program.name, why);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  prepare_standard_streams();
  try {
    run(argc, argv);
  } catch (const AlreadyReported&) {
    return 2;
  } catch (const OutputLost& error) {
    return fail(1, error.what());
  } catch (const splinertia::WriteError& error) {
    return fail(1, error.what());
  } catch (const NotAccepted& error) {
    return fail(3, error.what());
  } catch (const std::exception& error) {
    return fail(2, error.what());
  }
  errno = 0;
  const bool lost = std::fflush(stdout) != 0;
  if (!lost && std::ferror(stdout) == 0) return 0;
  return fail(1, errno != 0 ? std::strerror(errno) : "standard output cannot be written");
}
