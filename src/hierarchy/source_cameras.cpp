#include "hierarchy/source_cameras.h"

#include "core/angle.h"
#include "core/error.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace gnomon::hierarchy {

namespace {

constexpr std::size_t kNumbers = 10; // eye, target and up (three numbers each), and the angle

void putNumber(std::string& text, double number) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
    text.append(" ").append(digits.data(), end);
}

/// Removes the text before the next `end` from `rest`, and returns the removed text.
std::string_view takenUpTo(char end, std::string_view& rest) {
    const std::size_t length = std::min(rest.find(end), rest.size());
    const std::string_view taken = rest.substr(0, length);
    rest.remove_prefix(std::min(length + 1, rest.size()));
    return taken;
}

std::optional<Camera> cameraOfLine(std::string_view line) {
    Camera camera;
    const auto projection = valueOf(kProjections, takenUpTo(' ', line));
    std::array<double, kNumbers> numbers{};
    for (double& number : numbers) {
        const std::string_view word = takenUpTo(' ', line);
        const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), number);
        if (fault != std::errc() || end != word.data() + word.size() || !std::isfinite(number)) return std::nullopt;
    }
    const auto vectorAt = [&](std::size_t i) { return glm::dvec3(numbers[i], numbers[i + 1], numbers[i + 2]); };
    camera.eye = vectorAt(0);
    camera.target = vectorAt(3);
    camera.up = vectorAt(6);
    camera.fovYRadians = numbers[9];
    const bool hasAngle = camera.fovYRadians > 0 && camera.fovYRadians < kPi;
    if (!projection || !line.empty() || !hasAngle || camera.eye == camera.target) return std::nullopt;
    camera.projection = *projection;
    return camera;
}

} // namespace

std::string camerasText(std::span<const Camera> cameras) {
    std::string text;
    for (const Camera& camera : cameras) {
        text += wordOf(kProjections, camera.projection);
        for (const glm::dvec3& vector : {camera.eye, camera.target, camera.up})
            for (int i = 0; i < 3; ++i)
                putNumber(text, vector[i]);
        putNumber(text, camera.fovYRadians);
        text += '\n';
    }
    return text;
}

std::size_t cameraCount(const ModelSummary& summary) {
    const auto found = summary.options.find(kCamerasOption);
    if (found == summary.options.end()) return 0;
    return static_cast<std::size_t>(std::count(found->second.begin(), found->second.end(), '\n'));
}

std::vector<Camera> camerasOf(const ModelFile& model) {
    std::vector<Camera> cameras;
    const auto found = model.summary().options.find(kCamerasOption);
    if (found == model.summary().options.end()) return cameras;
    std::string_view rest = found->second;
    while (!rest.empty()) {
        const std::string_view line = takenUpTo('\n', rest);
        const std::optional<Camera> camera = cameraOfLine(line);
        if (!camera)
            throw Error(
                model.path(),
                "a stored camera of the source is damaged",
                "a projection and 10 numbers",
                "camera " + std::to_string(cameras.size()));
        cameras.push_back(*camera);
    }
    return cameras;
}

} // namespace gnomon::hierarchy
