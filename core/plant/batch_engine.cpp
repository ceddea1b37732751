// SPDX-License-Identifier: Apache-2.0
#include "core/plant/batch_engine.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <thread>

#include "core/base/count_text.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/plant/batch_worker.h"
#include "core/plant/plant_connection.h"

namespace spindrift {
namespace {

struct Child {
  std::string worker;
  int errors = -1;  ///< what it writes to standard error
  std::string said;
};

/// In a process group of its own, so that Ctrl+C at the terminal reaches the engine alone, which asks them to stop.
std::pair<pid_t, Child> start(std::vector<std::string> command) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw InputError("A worker cannot be started: no pipe.");
  std::vector<char*> arguments;
  for (std::string& a : command) arguments.push_back(a.data());
  arguments.push_back(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    ::setpgid(0, 0);
    const int nowhere = ::open("/dev/null", O_WRONLY);
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(ends[1], STDERR_FILENO);
    ::signal(SIGTERM, SIG_DFL);
    ::signal(SIGINT, SIG_DFL);
    // Inside a task of Slurm they still need names of their own.
    ::unsetenv("SLURM_ARRAY_JOB_ID");
    ::execvp(arguments[0], arguments.data());
    ::_exit(127);
  }
  ::close(ends[1]);
  if (child < 0) {
    ::close(ends[0]);
    throw InputError("A worker cannot be started: too many processes.");
  }
  ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  return {child, {fmt::format("local:{}:{}", host.data(), child), ends[0], ""}};
}

void listen(Child& child) {
  std::array<char, 4096> buffer{};
  for (ssize_t n; (n = ::read(child.errors, buffer.data(), buffer.size())) > 0;)
    child.said.append(buffer.data(), static_cast<std::size_t>(n));
  if (child.said.size() > 8192) child.said.erase(0, child.said.size() - 4096);
}

void nap(double s) {
  std::this_thread::sleep_for(std::chrono::duration<double>(s));
}

/// One look at the store at a time, each with patience.
template <typename Body>
auto patiently(const PlantAddress& address, double patience_s, Body body) {
  const auto begin = std::chrono::steady_clock::now();
  for (;;) {
    try {
      PlantStore store = PlantStore::open(address);
      BatchQueue queue(store);
      return body(queue);
    } catch (const PlantUnreachable&) {
      if (std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() > patience_s) throw;
    }
    nap(0.3);
  }
}

/// For the shell of a node: what stands between the quotes means itself.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string sbatch(const std::vector<std::string>& arguments) {
  std::vector<std::string> command{"sbatch", "--parsable"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  try {
    std::string said = outputOf(command, JobContext());
    const std::string job(trimmed(said.substr(0, said.find(';'))));
    if (job.empty() || job.find_first_not_of("0123456789") != std::string::npos)
      throw InputError("Slurm did not take the batch: sbatch said nothing but an error; see above.");
    return job;
  } catch (const InputError& e) {
    throw InputError(
        fmt::format("Slurm did not take the batch: {} Nothing is lost: start it again, or with --engine "
                    "local.",
                    e.what()));
  }
}

}  // namespace

EngineReport runLocally(const PlantAddress& address, std::int64_t batch, const EngineOptions& options,
                        JobContext& job) {
  EngineReport report;
  const int processes = options.processes > 0 ? options.processes : static_cast<int>(threadCount());
  std::vector<std::string> command = options.worker_command;
  command.push_back(std::to_string(batch));
  command.insert(command.end(), {"--store", address.text()});
  std::map<pid_t, Child> children;
  bool asked = false;
  int unhappy = 0;  // workers in a row that ended without having finished anything
  double pause_s = 0.05;
  for (;;) {
    // Who has ended?
    for (auto at = children.begin(); at != children.end();) {
      listen(at->second);
      int status = 0;
      if (::waitpid(at->first, &status, WNOHANG) != at->first) {
        ++at;
        continue;
      }
      listen(at->second);
      ::close(at->second.errors);
      if (WIFSIGNALED(status)) {
        ++report.killed;
        patiently(address, options.patience_s, [&](BatchQueue& queue) { queue.releaseDead(batch, at->second.worker); });
      } else if (WEXITSTATUS(status) != 0 && WEXITSTATUS(status) != gave_up) {
        std::string said(trimmed(at->second.said));
        if (const auto line = said.rfind('\n'); line != std::string::npos) said.erase(0, line + 1);
        if (WEXITSTATUS(status) == 127 && said.empty()) said = command[0] + " cannot be started.";
        if (++unhappy >= processes) report.refused = said;
      }
      at = children.erase(at);
    }
    const std::int64_t answered_before = report.state.answered;
    report.state = patiently(address, options.patience_s, [&](BatchQueue& queue) { return queue.state(batch); });
    if (report.state.answered > answered_before) unhappy = 0;
    job.report(report.state.items > 0
                   ? static_cast<double>(report.state.answered) / static_cast<double>(report.state.items)
                   : 1.0,
               fmt::format("{} of {}", report.state.answered, countOf(report.state.items, "item")));
    const bool over = report.state.finished() || report.state.cancelled || !report.refused.empty();
    if ((job.cancelled() || over) && !asked) {
      asked = true;
      report.stopped = job.cancelled();
      if (!report.state.finished()) {
        for (const auto& [pid, child] : children) ::kill(pid, SIGTERM);
      }
    }
    if (asked && children.empty()) return report;
    while (!asked &&
           static_cast<std::int64_t>(children.size()) < std::min<std::int64_t>(processes, report.state.open)) {
      children.insert(start(command));
      ++report.started;
    }
    nap(pause_s);
    pause_s = std::min(0.5, 1.5 * pause_s);
  }
}

std::string giveToSlurm(const PlantAddress& address, std::int64_t batch, const SlurmOptions& options) {
  std::error_code none;
  std::filesystem::create_directories(options.logs, none);
  const std::string begin =
      options.round == 1 ? "now"
                         : fmt::format("now+{:.0f}", std::max(1.0, options.lease_s));  // leases of the dead run out
  const std::string common = fmt::format("{} --store {}", batch, quoted(address.text()));
  std::vector<std::string> array{fmt::format("--array=0-{}", options.tasks - 1),
                                 fmt::format("--job-name=spindrift-{}", batch),
                                 "--requeue",
                                 "--open-mode=append",
                                 "--signal=B:TERM@30",
                                 "--no-kill",
                                 "--begin=" + begin,
                                 "--output=" + (options.logs / "%A_%a.log").string()};
  if (options.time_limit_min > 0) array.push_back(fmt::format("--time={}", options.time_limit_min));
  // exec: signals and the exit status are the worker's.
  array.push_back("--wrap=exec " + quoted(options.program) + " batch work " + common + " --engine slurm");
  std::string job = sbatch(array);
  (void)sbatch({fmt::format("--job-name=spindrift-{}-sweep", batch), "--dependency=afterany:" + job,
                "--output=" + (options.logs / "sweep_%j.log").string(),
                fmt::format("--wrap=exec {} batch sweep {} --tasks {} --logs {} --round {} --time-limit {}",
                            quoted(options.program), common, options.tasks, quoted(options.logs.string()),
                            options.round, options.time_limit_min)});
  return job;
}

}  // namespace spindrift
