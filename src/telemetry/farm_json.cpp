#include "telemetry/farm_json.h"

namespace gnomon::telemetry {

nlohmann::ordered_json farmJson(const FarmReport& report) {
    nlohmann::ordered_json ranks = nlohmann::ordered_json::array();
    for (const FarmMember& member : report.members)
        ranks.push_back(
            {{"rank", member.rank},
             {"host", member.host},
             {"threads", member.threads},
             {"tasks", member.tasks},
             {"busy_seconds", member.busySeconds},
             {"peak_rss_bytes", member.peakResidentBytes},
             {"bytes_sent", member.bytesSent}});
    nlohmann::ordered_json phases = nlohmann::ordered_json::array();
    for (const FarmPhase& phase : report.phases)
        phases.push_back(
            {{"name", phase.name},
             {"tasks", phase.tasks},
             {"idle_share", phase.idleShare},
             {"slowest_rank", phase.slowestRank}});
    return {{"ranks", ranks}, {"phases", phases}};
}

} // namespace gnomon::telemetry
