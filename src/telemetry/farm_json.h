// Who did what in a job of many processes, as JSON.
#pragma once

#include "core/process/task_farm.h"

#include <nlohmann/json.hpp>

namespace gnomon::telemetry {

/// `ranks`: of each process rank, host, threads, tasks, busy_seconds, peak_rss_bytes and bytes_sent; and `phases`: of
/// each name, tasks, idle_share and slowest_rank. As in the report of a build.
nlohmann::ordered_json farmJson(const FarmReport& report);

} // namespace gnomon::telemetry
