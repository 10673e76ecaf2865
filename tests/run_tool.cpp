#include "run_tool.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace shlight {
namespace {

using namespace std::chrono_literals;

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string read_all(int fd) {
  std::string text(static_cast<std::size_t>(::lseek(fd, 0, SEEK_END)), ' ');
  text.resize(static_cast<std::size_t>(::pread(fd, text.data(), text.size(), 0)));
  return text;
}

// The descriptor that the program gets as its stdout; -1 for none.
int open_stdout(Stdout kind, int captured) {
  switch (kind) {
    case Stdout::kCaptured:
      return ::dup(captured);
    case Stdout::kClosed:
      return -1;
    case Stdout::kFullDisk:
      return ::open("/dev/full", O_WRONLY);
    case Stdout::kNobodyReads: {
      int pipe[2] = {-1, -1};
      if (::pipe2(pipe, O_CLOEXEC) == 0) ::close(pipe[0]);
      return pipe[1];
    }
  }
  return -1;
}

}  // namespace

std::ostream& operator<<(std::ostream& stream, const ToolRun& run) {
  return stream << "exit code " << run.exit_code << ", signal " << run.signal << ", " << run.seconds
                << " s\nstdout: " << run.out.substr(0, 1000) << "\nstderr: " << run.err.substr(0, 1000);
}

ToolProcess::ToolProcess(const std::vector<std::string>& arguments, const RunToolParams& params)
    : timeout_(params.timeout),
      started_(now()),
      out_(::memfd_create("stdout", MFD_CLOEXEC)),
      err_(::memfd_create("stderr", MFD_CLOEXEC)) {
  const int standard_output = open_stdout(params.standard_output, out_);
  std::vector<char*> argv = {const_cast<char*>(SHLIGHT_PROGRAM)};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);

  pid_ = ::fork();
  if (pid_ < 0 || out_ < 0 || err_ < 0) throw std::runtime_error("cannot start a program");
  if (pid_ == 0) {
    // A group of its own, so that its children can be killed with it.
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ}) ::signal(signal, SIG_DFL);
    ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
    ::dup2(err_, STDERR_FILENO);
    if (standard_output >= 0)
      ::dup2(standard_output, STDOUT_FILENO);
    else
      ::close(STDOUT_FILENO);
    if (params.max_file_bytes > 0) {
      const rlimit limit = {params.max_file_bytes, params.max_file_bytes};
      ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    // Nothing else that the test has open.
    ::close_range(STDERR_FILENO + 1, ~0u, 0);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  ::setpgid(pid_, pid_);
  if (standard_output >= 0) ::close(standard_output);
}

ToolProcess::~ToolProcess() {
  if (!has_ended()) {
    ::kill(-pid_, SIGKILL);
    ::waitpid(pid_, &status_, 0);
  }
  ::close(out_);
  ::close(err_);
}

bool ToolProcess::has_ended() {
  if (!ended_) ended_ = ::waitpid(pid_, &status_, WNOHANG) == pid_;
  return ended_;
}

bool ToolProcess::wait_until_it_handles(int signal) {
  for (; !has_ended() && now() < started_ + timeout_; std::this_thread::sleep_for(1ms)) {
    std::ifstream status("/proc/" + std::to_string(pid_) + "/status");
    for (std::string key; status >> key;)
      if (key == "SigCgt:") {
        unsigned long long caught = 0;
        status >> std::hex >> caught;
        if (caught >> (signal - 1) & 1) return true;
      }
  }
  return false;
}

void ToolProcess::send(int signal) {
  if (!has_ended()) ::kill(pid_, signal);
}

ToolRun ToolProcess::wait() {
  for (bool killed = false; !has_ended(); std::this_thread::sleep_for(1ms))
    if (!killed && now() > started_ + timeout_) killed = ::kill(-pid_, SIGKILL) == 0;
  ToolRun run;
  run.seconds = now() - started_;
  if (WIFEXITED(status_)) run.exit_code = WEXITSTATUS(status_);
  if (WIFSIGNALED(status_)) run.signal = WTERMSIG(status_);
  run.out = read_all(out_);
  run.err = read_all(err_);
  return run;
}

}  // namespace shlight
