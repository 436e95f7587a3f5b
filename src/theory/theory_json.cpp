#include "theory/theory_json.h"

#include <array>

namespace gnomon::theory {

nlohmann::json describe(const Figure& figure) {
    constexpr std::array<const char*, 3> kKinds{"lines", "curves", "maps"};
    return {
        {"name", figure.name},
        {"kind", kKinds[static_cast<std::size_t>(figure.kind)]},
        {"title", figure.title},
        {"caption", figure.caption},
        {"x", figure.xLabel},
        {"y", figure.yLabel},
        {"log_x", figure.logX},
        {"log_y", figure.logY},
        {"panels", figure.panels},
        {"columns", figure.columns}};
}

nlohmann::json tableJson(std::span<const SchemeRow> table) {
    nlohmann::json rows = nlohmann::json::array();
    for (const SchemeRow& row : table)
        rows.push_back(
            {{"scheme", row.scheme},
             {"warp", row.warp},
             {"k", row.slices},
             {"maps", row.maps},
             {"storage_factor", row.storageFactor},
             {"storage_factor_sheared", row.shearedStorageFactor},
             {"M_x", row.worstX},
             {"M_z", row.worstZ}});
    return {{"rows", rows}};
}

} // namespace gnomon::theory
