// SPDX-License-Identifier: MIT
// What every program does around its work: exit codes, errors in one line, and no success where output is lost.
// Programs with options use program.hpp.
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

/// A result that is not good enough to be written. What is said then names the option that takes it all the same.
struct NotAccepted : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Something that was asked for could not be written.
struct OutputLost : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Bad input that has been reported on standard error.
struct AlreadyReported : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Makes lost output an error of the write: a closed pipe or a file that grows too large would end the program with a
/// signal, and a file that is opened while the standard output is closed would become it.
inline void prepare_standard_streams() {
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    const bool closed = ::fcntl(stream, F_GETFD) == -1;
    // In the direction that it is not used in. The lowest number that is free is that of the stream.
    if (closed) (void)::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

/// Does the work. Exit codes: 0 done, 1 output is lost, 2 bad input, 3 not accepted.
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
