// SPDX-License-Identifier: MIT
#include "support/python_script.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "support/concat.hpp"

extern char** environ;

namespace {

std::string reason(int error) { return std::generic_category().message(error); }

std::filesystem::path beside_this_program(const std::string& name) {
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) throw std::runtime_error(concat("cannot find the folder of this program: ", error.message()));
  return program.parent_path() / name;
}

}  // namespace

std::string default_python() {
  const char* chosen = std::getenv("SPLINERTIA_PYTHON");
  return chosen != nullptr && *chosen != '\0' ? chosen : "python3";
}

bool is_ros_bag(const std::filesystem::path& path) {
  std::error_code ignored;
  const auto ending = path.extension();
  return ending == ".bag" || ending == ".mcap" || ending == ".db3" || std::filesystem::is_directory(path, ignored);
}

PythonScript::PythonScript(const std::string& python, const std::string& name,
                           const std::vector<std::string>& arguments, Output output)
    : name_(name) {
  std::vector<std::string> words{python, beside_this_program(name).string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  std::fflush(stdout);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  std::array<int, 2> ends{-1, -1};
  if (output == Output::piped) {
    if (::pipe(ends.data()) != 0) throw std::runtime_error(concat("cannot make a pipe: ", reason(errno)));
    for (const int end : ends) ::fcntl(end, F_SETFD, FD_CLOEXEC);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  }
  const int error = ::posix_spawnp(&process_, python.c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (output == Output::piped) {
    ::close(ends[1]);
    pipe_ = ends[0];
  }
  if (error != 0) {
    process_ = -1;
    if (pipe_ >= 0) ::close(pipe_);
    throw std::runtime_error(concat("cannot run ", python, ", which ", name, " needs: ", reason(error),
                                    "; expected Python 3 (--python or SPLINERTIA_PYTHON)"));
  }
}

PythonScript::~PythonScript() {
  // A script that writes to the closed pipe ends.
  if (pipe_ >= 0) ::close(pipe_);
  if (process_ >= 0) ::waitpid(process_, nullptr, 0);
}

std::filesystem::path PythonScript::output() const { return concat("/dev/fd/", pipe_); }

void PythonScript::finish() {
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 2) throw ScriptFailed(name_ + " has refused its input");
  throw std::runtime_error(WIFEXITED(status) ? concat(name_, ": exit code ", WEXITSTATUS(status), ", expected 0")
                                             : concat(name_, ": ended by signal ", WTERMSIG(status)));
}

void draw_plot(const std::string& python, const std::string& name, const std::filesystem::path& folder) {
  try {
    PythonScript(python, "plot_" + name + ".py", {folder.string()}, PythonScript::Output::shared).finish();
    std::printf("wrote %s.png and %s.svg to %s\n", name.c_str(), name.c_str(), folder.string().c_str());
  } catch (const ScriptFailed&) {  // has printed the reason
  } catch (const std::runtime_error& error) {
    std::fprintf(stderr, "no plot: %s\n", error.what());
  }
}
