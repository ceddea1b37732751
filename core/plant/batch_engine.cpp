// SPDX-License-Identifier: Apache-2.0
#include "core/plant/batch_engine.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <thread>

#include "core/base/count_text.h"
#include "core/base/error.h"
#include "core/base/sha256.h"
#include "core/base/steady_seconds.h"
#include "core/base/text.h"
#include "core/plant/batch_work.h"
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
std::pair<pid_t, Child> start(std::vector<std::string> command, bool named_by_slurm) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw InputError("A worker cannot be started: no pipe.");
  std::vector<char*> arguments;
  for (std::string& a : command) arguments.push_back(a.data());
  arguments.push_back(nullptr);
  const pid_t engine = ::getpid();
  const pid_t child = ::fork();
  if (child == 0) {
    ::setpgid(0, 0);
    // Nobody would know of a worker whose engine was killed.
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != engine) ::_exit(0);
    const int nowhere = ::open("/dev/null", O_WRONLY);
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(ends[1], STDERR_FILENO);
    ::signal(SIGTERM, SIG_DFL);
    ::signal(SIGINT, SIG_DFL);
    // Inside a task of Slurm several of them need names of their own.
    if (!named_by_slurm) ::unsetenv("SLURM_ARRAY_JOB_ID");
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
  return {child, {named_by_slurm ? workerName() : fmt::format("local:{}:{}", host.data(), child), ends[0], ""}};
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
  std::vector<std::string> command{"timeout", "60", "sbatch", "--parsable"};
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

/// What cannot be cancelled is told by Slurm and finds nothing to do when it begins.
void scancel(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"timeout", "20", "scancel", "--quiet"});
  try {
    (void)outputOf(arguments, JobContext());
  } catch (const InputError&) {
  }
}

std::string giveTasks(const PlantAddress& address, std::int64_t batch, const SlurmOptions& options, int tasks,
                      double begin_s) {
  std::error_code none;
  std::filesystem::create_directories(options.logs, none);
  std::vector<std::string> array{fmt::format("--array=0-{}", tasks - 1),
                                 "--job-name=" + slurmName(address, batch),
                                 "--requeue",
                                 "--open-mode=append",
                                 "--signal=B:TERM@30",
                                 "--no-kill",
                                 "--begin=" + (begin_s > 0.0 ? fmt::format("now+{:.0f}", std::ceil(begin_s)) : "now"),
                                 "--output=" + (options.logs / "%A_%a.log").string()};
  if (options.time_limit_min > 0) array.push_back(fmt::format("--time={}", options.time_limit_min));
  // exec: signals and the exit status are the program's.
  array.push_back(
      fmt::format("--wrap=exec {} batch tend {} --store {}", quoted(options.program), batch, quoted(address.text())));
  return sbatch(array);
}

/// How many tasks are to be given so that `tasks` work while that many chunks are open; those that are stuck are taken
/// away.
int missingTasks(const SlurmOptions& options, const BatchState& state, const SlurmTasks& there) {
  if (!there.stuck.empty()) scancel(there.stuck);
  const std::int64_t wanted =
      std::min<std::int64_t>(options.tasks, state.open) - std::ssize(there.running) - there.waiting;
  return static_cast<int>(std::max<std::int64_t>(0, wanted));
}

/// Tasks that Slurm takes for running, and that are not: those that claim nothing although something is free.
class GhostWatch {
 public:
  explicit GhostWatch(double grace_s) : grace_s_(grace_s) {}
  /// Moves them from `running` to `stuck`.
  void sort(SlurmTasks& there, bool something_free, const std::vector<std::string>& workers) {
    const auto now = std::chrono::steady_clock::now();
    std::map<std::string, std::chrono::steady_clock::time_point> idle;
    std::vector<std::string> alive;
    for (const std::string& task : there.running) {
      const bool works = std::find(workers.begin(), workers.end(), "slurm:" + task) != workers.end();
      const auto before = idle_.find(task);
      const auto begin = before != idle_.end() ? before->second : now;
      if (something_free && !works) idle.emplace(task, begin);
      if (something_free && !works && secondsSince(begin) > grace_s_)
        there.stuck.push_back(task);
      else
        alive.push_back(task);
    }
    there.running = std::move(alive);
    idle_ = std::move(idle);
  }

 private:
  double grace_s_;
  std::map<std::string, std::chrono::steady_clock::time_point> idle_;
};

/// The last line of the newest log.
std::string lastWords(const std::filesystem::path& logs) {
  std::filesystem::path newest;
  std::filesystem::file_time_type when;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(logs, none)) {
    const auto written = entry.last_write_time(none);
    if (entry.file_size(none) == 0 || (!newest.empty() && written < when)) continue;
    newest = entry.path();
    when = written;
  }
  std::ifstream in(newest);
  std::string last;
  for (std::string line; std::getline(in, line);) {
    if (!trimmed(line).empty()) last = line;
  }
  return last;
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
  const bool named_by_slurm = options.engine == "slurm" && processes == 1;
  if (options.engine != "local") command.insert(command.end(), {"--engine", options.engine});
  std::optional<std::chrono::steady_clock::time_point> asked_store;
  for (;;) {
    // Who has ended?
    bool ended = false;
    for (auto at = children.begin(); at != children.end();) {
      listen(at->second);
      int status = 0;
      if (::waitpid(at->first, &status, WNOHANG) != at->first) {
        ++at;
        continue;
      }
      ended = true;
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
    const bool look = !asked_store || ended || secondsSince(*asked_store) >= options.poll_s;
    if (look) {
      report.state = patiently(address, options.patience_s, [&](BatchQueue& queue) { return queue.state(batch); });
      asked_store = std::chrono::steady_clock::now();
    }
    if (report.state.answered > answered_before) unhappy = 0;
    job.report(report.state.items > 0
                   ? static_cast<double>(report.state.answered) / static_cast<double>(report.state.items)
                   : 1.0,
               fmt::format("{} of {}", report.state.answered, countOf(report.state.items, "item")));
    const bool over = report.state.finished() || report.state.cancelled || !report.refused.empty() ||
                      (!options.stay && children.empty() && look && report.state.free == 0);
    if ((job.cancelled() || over) && !asked) {
      asked = true;
      report.stopped = job.cancelled();
      if (!report.state.finished()) {
        for (const auto& [pid, child] : children) ::kill(pid, SIGTERM);
      }
    }
    if (asked && children.empty()) return report;
    std::int64_t free = look ? report.state.free : 0;
    for (; !asked && free > 0 && static_cast<int>(children.size()) < processes; --free) {
      children.insert(start(command, named_by_slurm));
      ++report.started;
    }
    nap(pause_s);
    pause_s = std::min(0.5, 1.5 * pause_s);
  }
}

std::string slurmName(const PlantAddress& address, std::int64_t batch) {
  return fmt::format("spindrift-{}-{}", batch, sha256(address.text()).substr(0, 8));
}

std::optional<SlurmTasks> tasksInSlurm(const PlantAddress& address, std::int64_t batch, double patience_s) {
  // An error of squeue is no empty queue: its end is told by a word.
  const std::string said = [&] {
    try {
      return outputOf({"sh", "-c",
                       "timeout \"$1\" squeue --noheader --array --name \"$2\" --format '%T %r %i' 2>/dev/null "
                       "&& echo end",
                       "sh", fmt::format("{:.0f}", std::ceil(patience_s)), slurmName(address, batch)},
                      JobContext());
    } catch (const InputError&) {
      return std::string();
    }
  }();
  if (!said.ends_with("end\n")) return std::nullopt;
  SlurmTasks tasks;
  std::istringstream lines(said);
  for (std::string line; std::getline(lines, line) && line != "end";) {
    // The reason may be several words.
    const std::string state = line.substr(0, line.find(' '));
    const std::string number = line.substr(line.rfind(' ') + 1);
    const std::string reason = line.size() > state.size() + number.size() + 2
                                   ? line.substr(state.size() + 1, line.size() - state.size() - number.size() - 2)
                                   : "";
    if (state == "RUNNING" || state == "CONFIGURING") {
      tasks.running.push_back(number);
    } else if (state == "PENDING") {
      const bool held = reason.find("held") != std::string::npos || reason.find("Held") != std::string::npos ||
                        reason == "BeginTime" || reason == "DependencyNeverSatisfied" || reason == "BadConstraints";
      if (held) {
        tasks.stuck.push_back(number);
      } else {
        ++tasks.waiting;
        tasks.reason = reason;
      }
    }
  }
  return tasks;
}

std::string giveToSlurm(const PlantAddress& address, std::int64_t batch, const SlurmOptions& options) {
  const BatchState state = patiently(address, options.patience_s, [&](BatchQueue& q) { return q.state(batch); });
  const SlurmTasks there = tasksInSlurm(address, batch).value_or(SlurmTasks());
  const int missing = missingTasks(options, state, there);
  if (missing == 0) return "";
  // Where nothing is free, leases of the dead run out first.
  const std::string job = giveTasks(address, batch, options, missing, state.free > 0 ? 0.0 : options.lease_s);
  (void)sbatch({"--job-name=" + slurmName(address, batch) + "-sweep", "--dependency=afterany:" + job,
                "--output=" + (options.logs / "sweep_%j.log").string(),
                fmt::format("--wrap=exec {} batch sweep {} --store {} --tasks {} --logs {} --round {} --answered {} "
                            "--time-limit {}",
                            quoted(options.program), batch, quoted(address.text()), options.tasks,
                            quoted(options.logs.string()), options.round, state.answered, options.time_limit_min)});
  return job;
}

EngineReport runThroughSlurm(const PlantAddress& address, std::int64_t batch, const SlurmOptions& options,
                             JobContext& job) {
  EngineReport report;
  int rounds = 0;  // in a row that brought no answer
  std::int64_t answered = -1;
  std::string refusal;
  auto heard = std::chrono::steady_clock::now();
  auto given = heard;
  GhostWatch ghosts(options.grace_s);
  for (;;) {
    report.state = patiently(address, options.patience_s, [&](BatchQueue& queue) { return queue.state(batch); });
    const BatchState& state = report.state;
    job.report(state.items > 0 ? static_cast<double>(state.answered) / static_cast<double>(state.items) : 1.0,
               fmt::format("{} of {}{}", state.answered, countOf(state.items, "item"),
                           rounds > 1 ? fmt::format("; {} rounds of tasks brought no answer", rounds - 1) : ""));
    if (state.finished() || state.cancelled || job.cancelled()) {
      // What still waits would find nothing to do; what works on something gives it back.
      report.stopped = job.cancelled();
      scancel({"--name=" + slurmName(address, batch)});
      return report;
    }
    std::optional<SlurmTasks> there = tasksInSlurm(address, batch);
    if (!there) {
      if (secondsSince(heard) > options.patience_s)
        throw InputError(
            fmt::format("Slurm has not answered for {:.0f} min (squeue). Nothing is lost: batch resume {} "
                        "--engine slurm goes on.",
                        options.patience_s / 60.0, batch));
    } else {
      heard = std::chrono::steady_clock::now();
      ghosts.sort(*there, state.free > 0,
                  patiently(address, options.patience_s, [&](BatchQueue& queue) { return queue.workers(batch); }));
      if (state.answered > answered) rounds = 0;
      const int missing = missingTasks(options, state, *there);
      // Each round without an answer waits twice as long as the one before.
      const double pause_s = rounds == 0 ? 0.0 : std::min(60.0, std::ldexp(1.0, rounds - 1));
      if (missing > 0 && state.free > 0 && secondsSince(given) >= pause_s) {
        if (rounds >= options.rounds) {
          report.refused = refusal.empty() ? fmt::format("{} rounds of tasks brought no answer; the last log says: {}",
                                                         rounds, lastWords(options.logs))
                                           : refusal;
          return report;
        }
        ++rounds;
        answered = state.answered;
        given = std::chrono::steady_clock::now();
        const int tasks = static_cast<int>(std::min<std::int64_t>(missing, state.free));
        try {
          (void)giveTasks(address, batch, options, tasks, 0.0);
          report.started += tasks;
          refusal.clear();
        } catch (const InputError& e) {
          refusal = e.what();  // the controller may just be away
        }
      }
    }
    nap(0.5);
  }
}

}  // namespace spindrift
