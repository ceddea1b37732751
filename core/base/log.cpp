// SPDX-License-Identifier: Apache-2.0
#include "core/base/log.h"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/ringbuffer_sink.h>
#include <spdlog/sinks/rotating_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <memory>

namespace spindrift {
namespace {

constexpr const char* line_pattern = "%Y-%m-%dT%H:%M:%S.%eZ %L %v";

spdlog::sinks::ringbuffer_sink_mt& recent() {
  static const std::shared_ptr<spdlog::sinks::ringbuffer_sink_mt> instance = [] {
    auto made = std::make_shared<spdlog::sinks::ringbuffer_sink_mt>(200);
    made->set_formatter(std::make_unique<spdlog::pattern_formatter>(line_pattern, spdlog::pattern_time_type::utc, ""));
    return made;
  }();
  return *instance;
}

spdlog::logger& logger() {
  static const std::shared_ptr<spdlog::logger> instance = [] {
    auto to_terminal = std::make_shared<spdlog::sinks::stderr_sink_mt>();
    to_terminal->set_level(spdlog::level::warn);
    to_terminal->set_pattern("spindrift: %v");
    auto made = std::make_shared<spdlog::logger>("spindrift", to_terminal);
    made->set_level(spdlog::level::debug);
    made->sinks().push_back(std::shared_ptr<spdlog::sinks::sink>(&recent(), [](spdlog::sinks::sink*) {}));
    return made;
  }();
  return *instance;
}

}  // namespace

std::vector<std::string> recentMessages() {
  return recent().last_formatted();
}

void startLogFile(const std::filesystem::path& file) {
  auto to_file = std::make_shared<spdlog::sinks::rotating_file_sink_mt>(file.string(), std::size_t{2} << 20, 3);
  to_file->set_formatter(std::make_unique<spdlog::pattern_formatter>(line_pattern, spdlog::pattern_time_type::utc));
  logger().sinks().push_back(to_file);
  logger().flush_on(spdlog::level::info);
}

void log(LogLevel level, std::string_view text) {
  switch (level) {
    case LogLevel::Debug:
      logger().debug(text);
      break;
    case LogLevel::Info:
      logger().info(text);
      break;
    case LogLevel::Warning:
      logger().warn(text);
      break;
    case LogLevel::Error:
      logger().error(text);
      break;
  }
}

}  // namespace spindrift
