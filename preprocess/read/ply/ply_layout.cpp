#include "preprocess/read/ply/ply_layout.h"

#include "preprocess/read/words.h"

#include <algorithm>
#include <array>

namespace gnomon::read {

int indexListOf(const PlyElement& element) {
    const int list = element.indexOf("vertex_indices", "vertex_index");
    return list >= 0 && element.properties[static_cast<std::size_t>(list)].isList ? list : -1;
}

Role roleOf(const PlyElement& element) {
    if (element.name == "vertex") return Role::Vertices;
    if (element.name == "face" && indexListOf(element) >= 0) return Role::Faces;
    if (element.name == "tristrips" && indexListOf(element) >= 0) return Role::Strips;
    return Role::Other;
}

std::optional<ColorLayout> colorLayoutOf(const PlyElement& element) {
    constexpr std::array<std::array<const char*, 4>, 4> kNames = {
        {{"red", "green", "blue", "alpha"},
         {"diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha"},
         {"r", "g", "b", "a"},
         {"color_red", "color_green", "color_blue", "color_alpha"}}};
    const auto indexOf = [&](const char* name) {
        const auto found = std::ranges::find_if(element.properties, [&](const PlyProperty& property) {
            return !property.isList && lowered(property.name) == name;
        });
        return found == element.properties.end() ? -1 : static_cast<int>(found - element.properties.begin());
    };
    for (const auto& names : kNames) {
        ColorLayout layout{};
        std::transform(names.begin(), names.end(), layout.begin(), indexOf);
        if (layout[0] >= 0 && layout[1] >= 0 && layout[2] >= 0) return layout;
    }
    return std::nullopt;
}

bool needsMaxima(const PlyElement& element, const ColorLayout& colors) {
    return std::any_of(colors.begin(), colors.end(), [&](int index) {
        return index >= 0 && byteSize(element.properties[static_cast<std::size_t>(index)].type) > 1;
    });
}

ColorRule colorRuleOf(const PlyElement& element, const ColorLayout& colors, const std::array<double, 4>& maxima) {
    const auto propertyOf = [&](std::size_t channel) -> const PlyProperty& {
        return element.properties[static_cast<std::size_t>(colors[channel])];
    };
    const auto fullOf = [&](std::size_t channel, double max) {
        const PlyType type = propertyOf(channel).type;
        return isFloat(type) ? fullOfReals(max) : fullOfIntegers(max, largestOf(type));
    };
    const auto rangeOf = [&](std::size_t channel, double full) {
        return std::string(" of type ") + nameOf(propertyOf(channel).type) + " range from 0 to " +
               std::to_string(static_cast<std::uint64_t>(full));
    };
    ColorRule rule;
    const double max = std::max({maxima[0], maxima[1], maxima[2]});
    // Channels of the same type (the usual case) share one range.
    for (std::size_t channel = 0; channel < 3; ++channel)
        rule.full[channel] = fullOf(channel, propertyOf(channel).type == propertyOf(0).type ? max : maxima[channel]);
    const bool hasAlpha = colors[3] >= 0;
    if (hasAlpha) rule.full[3] = fullOf(3, maxima[3]);
    const bool isUsual = propertyOf(0).name == "red" && !needsMaxima(element, colors);
    if (isUsual) return rule;
    rule.remark = "colours of element " + element.name + " (" + propertyOf(0).name + ", " + propertyOf(1).name + ", " +
                  propertyOf(2).name + ")" + rangeOf(0, rule.full[0]);
    if (hasAlpha) rule.remark += ", those of " + propertyOf(3).name + rangeOf(3, rule.full[3]);
    return rule;
}

VertexLayout vertexLayoutOf(const PlyElement& element) {
    constexpr std::array<const char*, kColor> kNames = {"x", "y", "z", "nx", "ny", "nz"};
    VertexLayout layout;
    for (std::size_t slot = 0; slot < kVertexSlots; ++slot) {
        int found = slot < kColor ? element.indexOf(kNames[slot]) : -1;
        if (found >= 0 && element.properties[static_cast<std::size_t>(found)].isList) found = -1;
        layout.property[slot] = found;
        const PlyType type = found >= 0 ? element.properties[static_cast<std::size_t>(found)].type : PlyType::Float32;
        if (slot < kNormal)
            layout.isDouble |= type == PlyType::Float64 || type == PlyType::Int32 || type == PlyType::Uint32;
    }
    if (const std::optional<ColorLayout> colors = colorLayoutOf(element))
        std::copy(colors->begin(), colors->end(), layout.property.begin() + kColor);
    layout.hasNormals = layout.has(kNormal, 3);
    layout.hasColors = layout.has(kColor, 3);
    return layout;
}

namespace {

/// Returns the name under which a build counts a property that it drops. `channel` is 0 to 2 for red, green and blue of
/// a face colour, and 3 for alpha.
std::string droppedName(const PlyElement& element, const std::string& property, std::ptrdiff_t channel) {
    constexpr std::array kTexture = {"s", "t", "u", "v", "texture_u", "texture_v", "texcoord", "texnumber"};
    if (channel < 3) return kFaceColors;
    if (channel == 3) return "alpha";
    if (std::find(kTexture.begin(), kTexture.end(), property) != kTexture.end()) return "texture coordinates";
    return element.name + " " + property;
}

} // namespace

std::set<std::string> droppedNames(const PlyElement& element, Role role, const std::vector<std::string>& fields) {
    if (role == Role::Other) return {"element " + element.name};
    std::set<int> kept = {indexListOf(element)};
    const std::optional<ColorLayout> colors = colorLayoutOf(element);
    if (role == Role::Vertices) {
        const VertexLayout layout = vertexLayoutOf(element);
        kept = {layout.property.begin(), layout.property.begin() + (layout.hasNormals ? kColor : kNormal)};
    }
    std::set<std::string> names;
    for (int i = 0; i < static_cast<int>(element.properties.size()); ++i) {
        const std::string& property = element.properties[static_cast<std::size_t>(i)].name;
        const auto channel = colors ? std::find(colors->begin(), colors->end(), i) - colors->begin() : 4;
        const bool isField =
            role == Role::Vertices && std::find(fields.begin(), fields.end(), property) != fields.end();
        if (isField || kept.contains(i) || (channel < 3 && role == Role::Vertices)) continue;
        names.insert(droppedName(element, property, channel));
    }
    return names;
}

std::vector<std::size_t> fieldsOf(const PlyElement& element, const VertexLayout& layout) {
    std::vector<std::size_t> fields;
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
        const auto slot = std::ranges::find(layout.property, static_cast<int>(i));
        const bool isKept = slot != layout.property.end() &&
                            (slot < layout.property.begin() + kNormal ||
                             (slot < layout.property.begin() + kColor ? layout.hasNormals : layout.hasColors));
        if (!element.properties[i].isList && !isKept) fields.push_back(i);
    }
    return fields;
}

std::string listOf(const PlyElement& element, const std::vector<std::size_t>& fields) {
    std::string list = fields.empty() ? "none, since vertices have no other numbers" : "one of ";
    for (std::size_t i = 0; i < fields.size(); ++i)
        list += (i > 0 ? ", " : "") + element.properties[fields[i]].name;
    return list;
}

} // namespace gnomon::read
