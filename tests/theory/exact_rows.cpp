#include "tests/theory/exact_rows.h"

#include "tests/theory/exact_theory.h"

#include <limits>
#include <map>
#include <string>

namespace gnomon::theory {

namespace {

using nlohmann::json;

Real numberOf(const json& value) {
    return value == "inf" ? std::numeric_limits<double>::infinity() : value.get<double>();
}

json roundedOrInf(const Real& value) {
    if (!value.isFinite()) return "inf";
    return value.rounded();
}

exact::Vector vectorOf(const json& value) {
    return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}

exact::Vector lightOf(const json& inputs) {
    const exact::Vector l = vectorOf(inputs["L"]);
    const Real length = root(l.x * l.x + l.y * l.y + l.z * l.z);
    return {l.x / length, l.y / length, l.z / length};
}

exact::Frustum frustumOf(const json& inputs) {
    exact::Frustum v{numberOf(inputs["n"]), numberOf(inputs["f"]), inputs.value("theta_rad", 0.5235987755982988)};
    v.aspect = inputs.value("aspect", 1.0);
    return v;
}

json etaExpects(const json& inputs) {
    const exact::Frustum v = frustumOf(inputs);
    const Real nPrime = exact::nPrimeOfEta(v, numberOf(inputs["eta"]));
    return {
        {"n_prime", roundedOrInf(nPrime)},
        {"kappa", (1 / nPrime).rounded()},
        {"eta_back", exact::etaOfNPrime(v, nPrime).rounded()}};
}

json budgetExpects(const json& inputs) {
    const exact::Pair worst = exact::worstOverhead(frustumOf(inputs), numberOf(inputs["n_prime"]));
    const Real s = worst.x * numberOf(inputs["res_i"]);
    const Real t = worst.z * numberOf(inputs["res_i"]);
    const Real texels = numberOf(inputs["S0"]);
    const Real resS = root(texels * s / t);
    const Real resT = root(texels * t / s);
    return {
        {"res_s_star", s.rounded()},
        {"res_t_star", t.rounded()},
        {"res_s", resS.rounded()},
        {"res_t", resT.rounded()},
        {"M_x", (s / resS).rounded()},
        {"M_z", (t / resT).rounded()},
        {"storage_sum", (s * t).rounded()}};
}

json planesExpect(const json& inputs) {
    const int count = inputs["k"].get<int>();
    json planes = json::array();
    for (int i = 0; i <= count; ++i)
        planes.push_back(exact::split(numberOf(inputs["n"]), numberOf(inputs["f"]), count, i, 1).rounded());
    return {{"planes", planes}};
}

json closedFormsExpect(const json& inputs) {
    const auto forms = exact::closedForms(frustumOf(inputs), inputs["k"].get<int>());
    return {
        {"ZP_overhead", forms[0].rounded()},
        {"ZPW_overhead", forms[1].rounded()},
        {"ZP_behind_eq20", forms[2].rounded()},
        {"ZP_behind_exact", forms[3].rounded()},
        {"FPZPW_behind_eq21", forms[4].rounded()},
        {"FPZPW_behind_exact_with_near", forms[5].rounded()},
        {"optimal", forms[6].rounded()}};
}

json pointExpects(const json& inputs) {
    const exact::Pair m =
        exact::aliasingOverhead(frustumOf(inputs), numberOf(inputs["n_prime"]), numberOf(inputs["z"]));
    const Real image = numberOf(inputs["res_i"]);
    return {
        {"m_x", (m.x * image / numberOf(inputs["res_s"])).rounded()},
        {"m_z", (m.z * image / numberOf(inputs["res_t"])).rounded()}};
}

json overheadExpects(const json& inputs) {
    const exact::Frustum v = frustumOf(inputs);
    const Real nPrime = numberOf(inputs["n_prime"]);
    json result = {{"S_bar", exact::storageOverhead(v, nPrime).rounded()}};
    if (nPrime >= v.n) {
        const exact::Pair worst = exact::worstOverhead(v, nPrime);
        result["M_x"] = worst.x.rounded();
        result["M_z"] = worst.z.rounded();
    }
    return result;
}

json tsmExpects(const json& inputs) {
    const exact::Frustum v = frustumOf(inputs);
    const Real nPrime = exact::nPrimeTsm(v, numberOf(inputs["focus_from_near"]), numberOf(inputs["fraction"]));
    return {
        {"n_prime", roundedOrInf(nPrime)},
        {"in_minimal_range", nPrime >= v.n && nPrime <= exact::nPrimeLspsm(v)},
        {"S_bar", exact::storageOverhead(v, nPrime).rounded()}};
}

Real kappaByPolicy(const json& inputs, const exact::Fit& fit) {
    const std::string policy = inputs["policy"].get<std::string>();
    if (policy == "given") return numberOf(inputs["kappa"]);
    if (policy == "w04") return exact::kappaLspsm(fit);
    return policy == "minmz" ? exact::kappaMinimax(fit) : Real(0);
}

json generalExpects(const json& inputs) {
    const exact::Fit fit = exact::fitSlice(frustumOf(inputs), lightOf(inputs));
    const Real kappa = kappaByPolicy(inputs, fit);
    const exact::Measures found = exact::measures(fit, kappa);
    return {
        {"S", (found.mx * found.mz).rounded()},
        {"Mx", found.mx.rounded()},
        {"Mz", found.mz.rounded()},
        {"kappa", kappa.rounded()},
        {"d", fit.d.rounded()},
        {"W", found.width.rounded()},
        {"sin_gamma", exact::sinLightAngle(fit.frame.y).rounded()},
        {"zmin", fit.zMin.rounded()}};
}

json aspectExpects(const json& inputs) {
    json result = generalExpects(inputs);
    result.erase("sin_gamma");
    result.erase("zmin");
    return result;
}

json minExpects(const json& inputs) {
    const exact::Fit fit = exact::fitSlice(frustumOf(inputs), lightOf(inputs));
    std::optional<Real> max;
    if (inputs["policy"] == "auto") max = exact::kappaMinimax(fit);
    return {{"S", exact::minStorage(fit, max).rounded()}};
}

json mapExpects(const json& inputs) {
    const exact::Fit fit = exact::fitSlice(frustumOf(inputs), lightOf(inputs));
    const exact::Vector p = vectorOf(inputs["p_camera"]);
    const auto found = exact::pointOf(exact::mapOf(fit, numberOf(inputs["kappa"])), p);
    const Real pixel = exact::imageBeamWidth(fit.slice, p.z, 1);
    return {
        {"s", found[0].rounded()},
        {"t", found[1].rounded()},
        {"m_x", (found[3] / pixel).rounded()},
        {"m_z", (found[4] / pixel).rounded()},
        {"m_t_sheared", (found[5] / pixel).rounded()}};
}

/// The slice `index` of `count` self-similar ones.
exact::Frustum sliceOf(const json& inputs, int count, int index) {
    exact::Frustum part = frustumOf(inputs);
    const Real n = part.n;
    const Real f = part.f;
    part.n = exact::split(n, f, count, index, 1);
    part.f = exact::split(n, f, count, index + 1, 1);
    return part;
}

json slicesExpect(const json& inputs) {
    const int count = inputs["k"].get<int>();
    json each = json::array();
    Real sum = 0;
    for (int i = 0; i < count; ++i) {
        const exact::Fit fit = exact::fitSlice(sliceOf(inputs, count, i), lightOf(inputs));
        const exact::Measures found = exact::measures(fit, kappaByPolicy(inputs, fit));
        each.push_back((found.mx * found.mz).rounded());
        sum += found.mx * found.mz;
    }
    return {{"S_total", sum.rounded()}, {"maps", count}, {"S_per_slice", each}};
}

json facesExpect(const json& inputs) {
    const int count = inputs["k"].get<int>();
    const exact::Vector light = lightOf(inputs);
    std::vector<std::pair<const char*, exact::Side>> sides;
    constexpr std::array kNames{"top", "bottom", "left", "right"};
    for (std::size_t i = 0; i < kNames.size(); ++i)
        if (exact::bearsMap(frustumOf(inputs), light, exact::kSides[i]))
            sides.emplace_back(kNames[i], exact::kSides[i]);
    if (inputs["near"] == "include") sides.emplace_back("near", exact::Side::Near);
    json faces = json::array();
    Real sum = 0;
    for (int i = 0; i < count; ++i)
        for (const auto& [word, side] : sides) {
            const bool isNormalized = inputs["bisector"] == "norm";
            const exact::Fit fit = exact::fitFace(sliceOf(inputs, count, i), light, side, isNormalized);
            const Real kappa = side == exact::Side::Near ? Real(0) : kappaByPolicy(inputs, fit);
            const exact::Measures found = exact::measures(fit, kappa);
            sum += found.mx * found.mz;
            if (i > 0) continue;
            faces.push_back(
                {{"face", word},
                 {"S", (found.mx * found.mz).rounded()},
                 {"Mx", found.mx.rounded()},
                 {"Mz", found.mz.rounded()},
                 {"kappa", kappa.rounded()},
                 {"d", fit.d.rounded()},
                 {"W", found.width.rounded()}});
        }
    const auto maps = static_cast<std::size_t>(count) * sides.size();
    return {{"S_total", sum.rounded()}, {"maps", maps}, {"first_slice_faces", faces}};
}

} // namespace

json exactRow(const json& row) {
    static const std::map<std::string, json (*)(const json&)> kExpects = {
        {"eq11_eta", etaExpects},
        {"eq13_eq14_budget", budgetExpects},
        {"eq15_eq16_planes", planesExpect},
        {"eq17_to_21_appC", closedFormsExpect},
        {"eq7_eq8_point", pointExpects},
        {"eq9_eq10_eq12_overhead", overheadExpects},
        {"general_frustum", generalExpects},
        {"general_frustum_aspect", aspectExpects},
        {"general_frustum_auto", minExpects},
        {"general_frustum_sopt", minExpects},
        {"point_map", mapExpects},
        {"scheme_zp", slicesExpect},
        {"scheme_fp", facesExpect},
        {"tsm_80", tsmExpects},
    };
    return kExpects.at(row["family"].get<std::string>())(row["inputs"]);
}

} // namespace gnomon::theory
