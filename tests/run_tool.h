#pragma once

#include <sys/types.h>

#include <ostream>
#include <string>
#include <vector>

namespace shlight {

// Running the built program as its users do.

struct ToolRun {
  int exit_code = -1;  // -1 where a signal ended it
  int signal = 0;      // which one; SIGKILL where the time was up
  double seconds = 0;
  std::string out, err;
};

// What a failed expectation shows.
std::ostream& operator<<(std::ostream& stream, const ToolRun& run);

enum class Stdout { kCaptured, kClosed, kFullDisk, kNobodyReads };

struct RunToolParams {
  double timeout = 60;  // seconds, after which the program is killed
  Stdout standard_output = Stdout::kCaptured;
  unsigned long max_file_bytes = 0;  // that it can write into one file; 0: no limit
};

// The program, running. It is killed where the object goes before it ends.
class ToolProcess {
 public:
  explicit ToolProcess(const std::vector<std::string>& arguments, const RunToolParams& params = {});
  ToolProcess(const ToolProcess&) = delete;
  ToolProcess& operator=(const ToolProcess&) = delete;
  ~ToolProcess();

  // Waits until the program has its own handler of the signal; false where it ends without.
  bool wait_until_it_handles(int signal);
  void send(int signal);
  // Waits for the end. Call once.
  ToolRun wait();

 private:
  bool has_ended();

  double timeout_;
  double started_;
  int out_ = -1, err_ = -1;
  pid_t pid_ = -1;
  bool ended_ = false;
  int status_ = 0;
};

inline ToolRun run_tool(const std::vector<std::string>& arguments, const RunToolParams& params = {}) {
  return ToolProcess(arguments, params).wait();
}

}  // namespace shlight
