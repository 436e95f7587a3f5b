// Quantiles, and the machine and build on which a bench runs.
#pragma once

#include <map>
#include <span>
#include <string>

namespace gnomon::telemetry {

/// Returns the quantile of `values` at `fraction` in [0, 1], with linear interpolation between ranks. `values` must not
/// be empty.
double quantile(std::span<const double> values, double fraction);

/// Returns properties of this machine and build: date, host_name, host_class, num_cpus, cpu, memory_bytes, simd_bits,
/// governor, load, compiler, library_build_type, and the commit from $GNOMON_COMMIT or $GITHUB_SHA.
std::map<std::string, std::string> machineContext();

/// Returns the time that other virtual machines took from this one since its start, in processor seconds. Returns 0 if
/// it is unknown.
double stolenSeconds();

} // namespace gnomon::telemetry
