// The camera between keyframes against a slow twin: Hermite's cubic by its four conditions, slopes by differences.
#include "core/random.h"
#include "path/camera_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon::path {
namespace {

Camera anyCamera(Random& random) {
    Camera camera;
    for (int axis = 0; axis < 3; ++axis) {
        camera.eye[axis] = random.uniform(-10, 10);
        camera.target[axis] = random.uniform(-10, 10);
        camera.up[axis] = random.uniform(-1, 1);
    }
    camera.fovYRadians = random.uniform(0.2, 2.5);
    return camera;
}

/// A path of one to seven keyframes, some of them at the same time.
CameraPath anyTimes(Random& random) {
    CameraPath path;
    path.interpolation = random.below(2) == 0 ? Interpolation::Linear : Interpolation::CatmullRom;
    path.loop = random.below(3) == 0;
    double time = random.uniform(-5, 5);
    for (std::uint64_t keys = 1 + random.below(7); keys > 0; --keys) {
        path.keyframes.push_back({time, anyCamera(random)});
        time += random.below(6) == 0 ? 0 : random.uniform(0.1, 3);
    }
    return path;
}

/// The numbers of a camera, one behind another.
std::vector<double> numbersOf(const Camera& c) {
    return {c.eye.x, c.eye.y, c.eye.z, c.target.x, c.target.y, c.target.z, c.up.x, c.up.y, c.up.z, c.fovYRadians};
}

/// The slope at keyframe `at` between its neighbours: one-sided at the ends of the path, across the seam of a loop. The
/// first keyframe of a loop stands for its last one, too.
double slope(const CameraPath& path, std::size_t at, std::size_t number) {
    const std::vector<Keyframe>& keys = path.keyframes;
    const std::size_t last = keys.size() - 1;
    if (path.loop && last > 1 && (at == 0 || at == last)) {
        const double rise = numbersOf(keys[1].camera)[number] - numbersOf(keys[last - 1].camera)[number];
        return rise / (keys[1].time - keys[0].time + keys[last].time - keys[last - 1].time);
    }
    const std::size_t before = at > 0 ? at - 1 : at;
    const std::size_t after = std::min(at + 1, last);
    const double rise = numbersOf(keys[after].camera)[number] - numbersOf(keys[before].camera)[number];
    return rise / (keys[after].time - keys[before].time);
}

/// The value at `u` of the cubic on [0, 1] with these ends and slopes, by de Casteljau's halves of halves.
double cubic(double from, double slopeFrom, double to, double slopeTo, double u) {
    const double a = from + slopeFrom / 3;
    const double b = to - slopeTo / 3;
    const auto mix = [u](double x, double y) { return x + (y - x) * u; };
    return mix(mix(mix(from, a), mix(a, b)), mix(mix(a, b), mix(b, to)));
}

/// The time that stands for `time` on a path that loops.
double wrapped(const CameraPath& path, double time) {
    const double start = path.keyframes.front().time;
    if (!path.loop || path.duration() <= 0) return time;
    while (time < start)
        time += path.duration();
    while (time >= start + path.duration())
        time -= path.duration();
    return time;
}

std::vector<double> twin(const CameraPath& path, double time) {
    const std::vector<Keyframe>& keys = path.keyframes;
    time = wrapped(path, time);
    if (time <= keys.front().time) return numbersOf(keys.front().camera);
    if (time >= keys.back().time) return numbersOf(keys.back().camera);
    std::size_t at = 0;
    while (keys[at + 1].time <= time)
        ++at;
    const double span = keys[at + 1].time - keys[at].time;
    const double u = (time - keys[at].time) / span;
    std::vector<double> result = numbersOf(keys[at].camera);
    for (std::size_t i = 0; i < result.size(); ++i) {
        const double from = numbersOf(keys[at].camera)[i];
        const double to = numbersOf(keys[at + 1].camera)[i];
        result[i] = from + (to - from) * u;
        if (path.interpolation == Interpolation::Linear) continue;
        result[i] = cubic(from, slope(path, at, i) * span, to, slope(path, at + 1, i) * span, u);
    }
    const double a = keys[at].camera.fovYRadians;
    const double b = keys[at + 1].camera.fovYRadians;
    result.back() = std::clamp(result.back(), std::min(a, b), std::max(a, b));
    return result;
}

TEST(RandomPath, LeadsWhereItsSlowTwinLeads) {
    Random random(1);
    for (int trial = 0; trial < 1500; ++trial) {
        const CameraPath path = anyTimes(random);
        for (int i = 0; i < 20; ++i) {
            const double time = path.keyframes.front().time + random.uniform(-0.5, 1.5) * (path.duration() + 1);
            const std::vector<double> found = numbersOf(cameraAt(path, time));
            const std::vector<double> expected = twin(path, time);
            for (std::size_t number = 0; number < found.size(); ++number)
                ASSERT_NEAR(found[number], expected[number], 1e-7) << "trial " << trial << ", number " << number;
        }
    }
}

TEST(RandomPath, PassesThroughItsKeyframesAndIsHeldAtItsEnds) {
    Random random(2);
    for (int trial = 0; trial < 300; ++trial) {
        CameraPath path = anyTimes(random);
        path.loop = false;
        const std::vector<Keyframe>& keys = path.keyframes;
        for (std::size_t i = 0; i < keys.size(); ++i) {
            if (i + 1 < keys.size() && keys[i + 1].time == keys[i].time) continue; // a cut: the later one counts
            if (i > 0 && i + 1 == keys.size() && keys[i - 1].time == keys[i].time && keys.size() == 2) continue;
            const bool isCutAtStart = keys[i].time == keys.front().time;
            const Camera& expected = isCutAtStart ? keys.front().camera : keys[i].camera;
            const std::vector<double> found = numbersOf(cameraAt(path, keys[i].time));
            for (std::size_t number = 0; number < found.size(); ++number)
                EXPECT_NEAR(found[number], numbersOf(expected)[number], 1e-9);
        }
        EXPECT_EQ(cameraAt(path, keys.front().time - 100).eye, keys.front().camera.eye);
        EXPECT_EQ(cameraAt(path, keys.back().time + 100).eye, keys.back().camera.eye);
    }
}

TEST(RandomPath, WalksAStraightLineEvenlyInEitherWay) {
    Random random(3);
    for (const Interpolation interpolation : {Interpolation::Linear, Interpolation::CatmullRom}) {
        CameraPath path;
        path.interpolation = interpolation;
        const Camera from = anyCamera(random);
        const glm::dvec3 velocity(1, -2, 0.5);
        double time = 0;
        for (int i = 0; i < 8; ++i) { // at uneven times
            Camera camera = from;
            camera.eye += velocity * time;
            path.keyframes.push_back({time, camera});
            time += random.uniform(0.1, 2);
        }
        for (double at = 0; at < path.duration(); at += 0.05)
            EXPECT_LE(glm::length(cameraAt(path, at).eye - (from.eye + velocity * at)), 1e-9);
    }
}

TEST(RandomPath, GoesRoundWithoutEnd) {
    Random random(4);
    for (int trial = 0; trial < 200; ++trial) {
        CameraPath path = anyTimes(random);
        path.loop = true;
        if (path.duration() <= 0) continue;
        const double time = path.keyframes.front().time + random.unit() * path.duration();
        const glm::dvec3 eye = cameraAt(path, time).eye;
        for (const int round : {-3, -1, 1, 2, 50})
            EXPECT_LE(glm::length(cameraAt(path, time + round * path.duration()).eye - eye), 1e-6) << round;
    }
}

TEST(RandomPath, HasItsFramesEvenlyWithBothEndsAmongThem) {
    Random random(5);
    for (int trial = 0; trial < 200; ++trial) {
        const CameraPath path = anyTimes(random);
        const int frames = 2 + static_cast<int>(random.below(50));
        EXPECT_DOUBLE_EQ(frameTime(path, 0, frames), path.keyframes.front().time);
        const double step = path.duration() / (path.loop ? frames : frames - 1);
        const double end = path.keyframes.front().time + path.duration() - (path.loop ? step : 0);
        EXPECT_NEAR(frameTime(path, frames - 1, frames), end, 1e-9) << "the end of a loop is its start";
        for (int frame = 1; frame < frames; ++frame)
            EXPECT_NEAR(frameTime(path, frame, frames) - frameTime(path, frame - 1, frames), step, 1e-9);
        EXPECT_EQ(frameTime(path, 0, 1), path.keyframes.front().time) << "a lone frame is the first";
    }
}

} // namespace
} // namespace gnomon::path
