#include "theory/rows.h"

#include "core/error.h"
#include "shadow/scheme.h"
#include "shadow/warp/warped_map.h"
#include "telemetry/json_text.h"

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace gnomon::theory {

namespace {

using nlohmann::json;
using namespace gnomon::shadow;

/// The inputs of one row of a formula, and the name of the row in error messages.
struct Row {
    const json& inputs;
    std::string where;

    const json& at(const char* key) const {
        const auto found = inputs.find(key);
        if (found == inputs.end())
            throw Error(where, std::string("input ") + key + " is missing", "a value", "nothing");
        return *found;
    }

    double number(const char* key) const {
        const json& value = at(key);
        if (value == "inf") return std::numeric_limits<double>::infinity();
        if (!value.is_number()) throw Error(where, std::string("input ") + key, "a number", telemetry::jsonText(value));
        return value.get<double>();
    }

    std::string text(const char* key) const {
        const json& value = at(key);
        if (!value.is_string()) throw Error(where, std::string("input ") + key, "a string", telemetry::jsonText(value));
        return value.get<std::string>();
    }

    int count(const char* key) const {
        const double value = number(key);
        if (!(value >= 1 && value <= 4096 && value == std::floor(value)))
            throw Error(
                where,
                std::string("input ") + key,
                "a whole number from 1 to 4096",
                telemetry::jsonText(inputs.at(key)));
        return static_cast<int>(value);
    }

    glm::dvec3 vector(const char* key) const {
        const json& value = at(key);
        glm::dvec3 result;
        const bool isVector = value.is_array() && value.size() == 3;
        for (int i = 0; i < 3; ++i) {
            const auto index = static_cast<std::size_t>(i);
            if (!isVector || !value[index].is_number())
                throw Error(where, std::string("input ") + key, "three numbers", telemetry::jsonText(value));
            result[i] = value[index].get<double>();
        }
        return result;
    }

    glm::dvec3 light() const {
        const glm::dvec3 towardsLight = vector("L");
        const double length = glm::length(towardsLight);
        if (!(length > 0 && std::isfinite(length)))
            throw Error(where, "input L", "a direction", telemetry::jsonText(inputs.at("L")));
        return towardsLight / length;
    }

    ViewFrustum frustum() const {
        ViewFrustum result;
        result.near = number("n");
        result.far = number("f");
        if (inputs.contains("theta_rad")) result.halfFovYRadians = number("theta_rad");
        if (inputs.contains("aspect")) result.aspect = number("aspect");
        try {
            requireValid(result);
        } catch (const Error& error) {
            throw Error(where, error.what());
        }
        return result;
    }

    Warp warp() const {
        const std::string policy = text("policy");
        constexpr std::array<std::pair<std::string_view, WarpRule>, 13> kPolicies{{
            {"minmz", WarpRule::Minimax},
            {"minimax", WarpRule::Minimax},
            {"ortho", WarpRule::None},
            {"none", WarpRule::None},
            {"w04", WarpRule::Lspsm},
            {"lspsm", WarpRule::Lspsm},
            {"sopt", WarpRule::MinStorage},
            {"auto", WarpRule::Auto},
            {"psm", WarpRule::Psm},
            {"tsm", WarpRule::Tsm},
            {"eta", WarpRule::Eta},
            {"given", WarpRule::Given},
            {"log", WarpRule::Log},
        }};
        for (const auto& [word, rule] : kPolicies) {
            if (policy != word) continue;
            Warp result;
            result.rule = rule;
            if (rule == WarpRule::Given) result.kappa = number("kappa");
            if (rule == WarpRule::Tsm) result.tsmFocus = number("focus_from_near");
            if (rule == WarpRule::Eta) result.eta = number("eta");
            return result;
        }
        throw Error(
            where,
            "unknown policy",
            "minmz, minimax, ortho, none, w04, lspsm, sopt, auto, psm, tsm, eta, given or log",
            policy);
    }
};

/// Returns a number as JSON, in which "inf" stands for infinity, because JSON has no such number.
json numberOrInf(double value) {
    if (std::isinf(value)) return "inf";
    return value;
}

json etaRow(const Row& row) {
    const ViewFrustum frustum = row.frustum();
    const double nPrime = nPrimeOfEta(frustum, row.number("eta"));
    return {{"n_prime", numberOrInf(nPrime)}, {"kappa", 1 / nPrime}, {"eta_back", etaOfNPrime(frustum, nPrime)}};
}

json budgetRow(const Row& row) {
    const BudgetOverhead budget =
        budgetOverhead(row.frustum(), row.number("n_prime"), row.number("S0"), row.number("res_i"));
    return {
        {"res_s_star", budget.criticalS},
        {"res_t_star", budget.criticalT},
        {"res_s", budget.s},
        {"res_t", budget.t},
        {"M_x", budget.worst.x},
        {"M_z", budget.worst.z},
        {"storage_sum", budget.criticalS * budget.criticalT}};
}

json planesRow(const Row& row) {
    return {{"planes", selfSimilarSplits(row.number("n"), row.number("f"), row.count("k"))}};
}

json closedFormsRow(const Row& row) {
    const ClosedForms forms = closedForms(row.frustum(), row.count("k"));
    return {
        {"ZP_overhead", forms.zpOverhead},
        {"ZPW_overhead", forms.zpWarpOverhead},
        {"ZP_behind_eq20", forms.zpBehindPaper},
        {"ZP_behind_exact", forms.zpBehind},
        {"FPZPW_behind_eq21", forms.facesBehindPaper},
        {"FPZPW_behind_exact_with_near", forms.facesBehind},
        {"optimal", forms.optimal}};
}

json pointErrorRow(const Row& row) {
    const Resolution resolution{row.number("res_i"), row.number("res_s"), row.number("res_t")};
    const Aliasing m = aliasingOverhead(row.frustum(), row.number("n_prime"), row.number("z"), resolution);
    return {{"m_x", m.x}, {"m_z", m.z}};
}

json overheadRow(const Row& row) {
    const ViewFrustum frustum = row.frustum();
    const double nPrime = row.number("n_prime");
    json got = {{"S_bar", storageFactorOverhead(frustum, nPrime)}};
    if (nPrime >= frustum.near) {
        const Aliasing worst = worstAliasingOverhead(frustum, nPrime);
        got["M_x"] = worst.x;
        got["M_z"] = worst.z;
    }
    return got;
}

json generalRow(const Row& row) {
    const LightFit fit = fitSlice(lightFrame(row.light()), row.frustum());
    const double kappa = kappaOf(row.warp(), fit);
    const Aliasing worst = worstAliasing(fit, kappa);
    return {
        {"S", worst.x * worst.z},
        {"Mx", worst.x},
        {"Mz", worst.z},
        {"kappa", kappa},
        {"d", fit.length},
        {"W", warpedExtent(fit, kappa).width()},
        {"sin_gamma", sinLightAngle(fit.frame.y)},
        {"zmin", fit.zMin}};
}

json aspectRow(const Row& row) {
    json got = generalRow(row);
    got.erase("sin_gamma");
    got.erase("zmin");
    return got;
}

json storageRow(const Row& row) {
    return {{"S", generalRow(row)["S"]}};
}

json pointMapRow(const Row& row) {
    const ViewFrustum frustum = row.frustum();
    const LightFit fit = fitSlice(lightFrame(row.light()), frustum);
    const WarpedMap map = warpedMap(fit, row.number("kappa"));
    const glm::dvec3 p = row.vector("p_camera");
    const MapPoint at = mapPoint(map, p);
    const LightBeam beam = lightBeam(map, p, {});
    const double pixel = imageBeamWidth(frustum, p.z, 1);
    return {
        {"s", at.s},
        {"t", at.t},
        {"m_x", beam.x / pixel},
        {"m_z", beam.z / pixel},
        {"m_t_sheared", beam.sheared / pixel}};
}

std::vector<SchemeMap> schemeOf(const Row& row) {
    Scheme scheme;
    scheme.warp = row.warp();
    scheme.slices = row.count("k");
    scheme.faces = row.inputs.contains("bisector");
    if (scheme.faces) {
        scheme.bisector = row.text("bisector") == "norm" ? Bisector::Normalized : Bisector::Literal;
        scheme.nearFace = row.text("near") == "include" ? NearFace::OwnMap : NearFace::Omit;
    }
    return schemeMaps(row.frustum(), row.light(), scheme);
}

json slicesRow(const Row& row) {
    const std::vector<SchemeMap> maps = schemeOf(row);
    json perSlice = json::array();
    for (const SchemeMap& map : maps)
        perSlice.push_back(map.storageFactor());
    return {{"S_total", storageFactor(maps)}, {"maps", maps.size()}, {"S_per_slice", perSlice}};
}

json facesRow(const Row& row) {
    const std::vector<SchemeMap> maps = schemeOf(row);
    json faces = json::array();
    for (const SchemeMap& map : maps) {
        if (map.slice != 0) break;
        faces.push_back(
            {{"face", name(map.face)},
             {"S", map.storageFactor()},
             {"Mx", map.unit.x},
             {"Mz", map.unit.z},
             {"kappa", map.kappa},
             {"d", map.fit.length},
             {"W", warpedExtent(map.fit, map.kappa).width()}});
    }
    return {{"S_total", storageFactor(maps)}, {"maps", maps.size()}, {"first_slice_faces", faces}};
}

json tsmRow(const Row& row) {
    const ViewFrustum frustum = row.frustum();
    const double nPrime = nPrimeTsm(frustum, row.number("focus_from_near"), row.number("fraction"));
    const bool minimal = nPrime >= frustum.near && nPrime <= nPrimeLspsm(frustum);
    return {
        {"n_prime", numberOrInf(nPrime)},
        {"in_minimal_range", minimal},
        {"S_bar", storageFactorOverhead(frustum, nPrime)}};
}

using Evaluate = json (*)(const Row&);

constexpr std::array<std::pair<std::string_view, Evaluate>, 14> kFamilies{{
    {"eq11_eta", etaRow},
    {"eq13_eq14_budget", budgetRow},
    {"eq15_eq16_planes", planesRow},
    {"eq17_to_21_appC", closedFormsRow},
    {"eq7_eq8_point", pointErrorRow},
    {"eq9_eq10_eq12_overhead", overheadRow},
    {"general_frustum", generalRow},
    {"general_frustum_aspect", aspectRow},
    {"general_frustum_auto", storageRow},
    {"general_frustum_sopt", storageRow},
    {"point_map", pointMapRow},
    {"scheme_zp", slicesRow},
    {"scheme_fp", facesRow},
    {"tsm_80", tsmRow},
}};

json evaluate(const std::string& family, const Row& row) {
    for (const auto& [word, function] : kFamilies)
        if (family == word) return function(row);
    std::string known;
    for (const auto& each : kFamilies)
        known += (known.empty() ? "" : ", ") + std::string(each.first);
    throw Error(row.where, "unknown family", "one of " + known, family);
}

} // namespace

json evaluateRows(const json& document, const std::string& where) {
    if (!document.is_object() || !document.contains("rows") || !document["rows"].is_array())
        throw Error(where, "the document", "an object with an array named rows", "something else");
    json rows = json::array();
    for (const json& row : document["rows"]) {
        const std::string place = where + ": row " + std::to_string(rows.size());
        const bool complete = row.is_object() && row.contains("family") && row["family"].is_string() &&
                              row.contains("inputs") && row["inputs"].is_object();
        if (!complete) throw Error(place, "a row", "family and inputs", telemetry::jsonText(row).substr(0, 80));
        json answer = {{"got", evaluate(row["family"].get<std::string>(), Row{row["inputs"], place})}};
        if (row.contains("id")) answer["id"] = row["id"];
        rows.push_back(std::move(answer));
    }
    return {{"rows", std::move(rows)}};
}

} // namespace gnomon::theory
