// SPDX-License-Identifier: MIT
// The frame of every program: exit codes, errors in one line, and failure if output is lost. Programs with options use
// program.hpp.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <splinertia/io/write_error.hpp>
#include <stdexcept>

/// A result that is not good enough to be written. The message names the option that writes it anyway.
struct NotAccepted : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A requested output could not be written.
struct OutputLost : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Bad input that has been reported on standard error.
struct AlreadyReported : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Makes lost output an error of the write. Without this, a closed pipe or a file that grows too large ends the program
/// with a signal, and a file that is opened while standard output is closed becomes the standard output.
inline void prepare_standard_streams() {
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    const bool closed = ::fcntl(stream, F_GETFD) == -1;
    // Opened in the direction that the stream does not use, so that its use fails. open() returns the lowest free
    // descriptor, which is that of the stream.
    if (closed) (void)::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

/// Calls work() and returns the exit code: 0 done, 1 output is lost, 2 bad input, 3 not accepted.
[[nodiscard]] int run_program(const char* name, const auto& work) {
  prepare_standard_streams();
  const auto fail = [name](int code, const char* why) {
    std::fflush(stdout);
    std::fprintf(stderr, "%s: %s\n", name, why);
    return code;
  };
  try {
    work();
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
