// Files of cameras and paths: what is written reads back to the last bit, and what is wrong is told with its keyframe.
#include "core/error.h"
#include "core/random.h"
#include "path/camera_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <set>

#include <nlohmann/json.hpp>
#include <unistd.h>

namespace gnomon::path {
namespace {

using nlohmann::ordered_json;

const std::string& filePath() {
    static const std::string path = testing::TempDir() + "gnomon_camera_files_" + std::to_string(::getpid());
    return path;
}

/// What `read` makes of a file of `text`.
template <class Read>
auto fromText(const std::string& text, const Read& read) {
    std::ofstream(filePath()) << text; // each overwrites the one before
    return read(filePath());
}

/// What is said against a path file of `document`; empty if nothing is.
std::string objection(const ordered_json& document) {
    try {
        fromText(document.dump(), readCameraPath);
        return {};
    } catch (const Error& error) {
        return error.what();
    }
}

ordered_json keyframe(double time) {
    return {{"time", time}, {"eye", {0, 1, 5}}, {"target", {0, 1, 0}}, {"up", {0, 1, 0}}, {"fov_y", 60}};
}

/// A path whose second keyframe of three `change` has changed.
ordered_json changed(const std::function<void(ordered_json&)>& change) {
    ordered_json document = {{"keyframes", {keyframe(0), keyframe(1), keyframe(2)}}};
    change(document["keyframes"][1]);
    return document;
}

const std::string kPlace = filePath() + ": keyframe 1";

TEST(CameraFiles, NameTheKeyframeWhoseVectorIsNone) {
    for (const char* key : {"eye", "target", "up"}) {
        const std::string said =
            kPlace + ": \"" + key + "\" is missing or not a vector: expected [x, y, z], found none";
        for (const ordered_json& wrong :
             {ordered_json(3),
              ordered_json("0,0,0"),
              ordered_json({1, 2}),
              ordered_json({1, 2, 3, 4}),
              ordered_json({1, "2", 3}),
              ordered_json({1, nullptr, 3}),
              ordered_json(nullptr)})
            EXPECT_EQ(objection(changed([&](ordered_json& frame) { frame[key] = wrong; })), said) << wrong;
    }
    for (const char* key : {"eye", "target"})
        EXPECT_TRUE(objection(changed([&](ordered_json& frame) { frame.erase(key); })).starts_with(kPlace)) << key;
    for (const char* key : {"up", "fov_y"})
        EXPECT_EQ(objection(changed([&](ordered_json& frame) { frame.erase(key); })), "") << key << " may be missing";
}

TEST(CameraFiles, NameTheKeyframeWhoseAngleOrTimeIsNone) {
    for (const double degrees : {0.0, -60.0, 180.0, 720.0})
        EXPECT_TRUE(objection(changed([&](ordered_json& frame) {
                        frame["fov_y"] = degrees;
                    })).starts_with(kPlace + ": \"fov_y\" is out of range: expected above 0 and below 180 degrees"))
            << degrees;
    for (const char* key : {"fov_y", "time"})
        for (const ordered_json& wrong : {ordered_json("60"), ordered_json(nullptr), ordered_json(true)})
            EXPECT_EQ(
                objection(changed([&](ordered_json& frame) { frame[key] = wrong; })),
                kPlace + ": \"" + key + "\" is missing or not a number");
    EXPECT_EQ(
        objection(changed([](ordered_json& frame) { frame.erase("time"); })),
        kPlace + ": \"time\" is missing or not a number");
}

TEST(CameraFiles, NameTheKeyframeThatGoesBackInTimeOrLooksAtItself) {
    EXPECT_EQ(
        objection(changed([](ordered_json& frame) { frame["time"] = -0.001; })),
        kPlace + ": keyframes must be in the order of their times");
    EXPECT_EQ(objection(changed([](ordered_json& frame) { frame["time"] = 0; })), "") << "a cut";
    EXPECT_NE(objection(changed([](ordered_json& frame) { frame["target"] = frame["eye"]; })), "");
    EXPECT_EQ(objection(changed([](ordered_json& frame) { frame["up"] = {0, 0, 1}; })), "") << "along the view";
    EXPECT_TRUE(
        objection(changed([](ordered_json& frame) { frame = 3; })).starts_with(kPlace + ": the camera is not a JSON"));
}

TEST(CameraFiles, OfNoPathAreRefusedWhole) {
    for (const ordered_json& none :
         {ordered_json(3),
          ordered_json::array(),
          ordered_json::object(),
          ordered_json{{"keyframes", 3}},
          ordered_json{{"keyframes", ordered_json::array()}},
          ordered_json{{"keyframes", {{"time", 0}}}}})
        EXPECT_TRUE(objection(none).starts_with(filePath() + ": ")) << none << objection(none);
    for (const char* text : {"", "{", "{\"keyframes\": [", "nonsense"})
        EXPECT_THROW(fromText(text, readCameraPath), Error) << text;
    EXPECT_THROW(readCameraPath("/no/such/path.json"), Error);
}

TEST(CameraFiles, OfOneCameraAreAKeyframeWithoutATime) {
    ordered_json camera = keyframe(0);
    camera.erase("time");
    const Camera read = fromText(camera.dump(), readCamera);
    EXPECT_EQ(read.eye, glm::dvec3(0, 1, 5));
    EXPECT_DOUBLE_EQ(read.fovYRadians, std::numbers::pi / 3);
    camera.erase("fov_y");
    camera.erase("up");
    EXPECT_EQ(fromText(camera.dump(), readCamera).up, glm::dvec3(0, 1, 0));
    EXPECT_DOUBLE_EQ(fromText(camera.dump(), readCamera).fovYRadians, std::numbers::pi / 3);
    EXPECT_THROW(fromText("[]", readCamera), Error);
}

TEST(CameraFiles, OfAPathGiveItsFirstCamera) {
    ordered_json second = keyframe(1);
    second["eye"] = {7, 7, 7};
    const Camera read = fromText(ordered_json{{"keyframes", {keyframe(0), second}}}.dump(), readCamera);
    EXPECT_EQ(read.eye, glm::dvec3(0, 1, 5));
    EXPECT_THROW(fromText(ordered_json{{"keyframes", ordered_json::array()}}.dump(), readCamera), Error);
}

TEST(CameraFiles, AreNoGltf) {
    for (const char* const name : {"/no/such/c.gltf", "/no/such/c.glb"})
        for (const auto& read :
             {std::function<void(const std::string&)>(readCamera),
              std::function<void(const std::string&)>(readCameraPath)})
            try {
                read(name);
                ADD_FAILURE() << name;
            } catch (const Error& error) {
                EXPECT_NE(std::string(error.what()).find("(kind source)"), std::string::npos) << error.what();
            }
}

CameraPath anyPath(Random& random) {
    CameraPath path;
    path.loop = random.below(2) == 0;
    path.interpolation = random.below(2) == 0 ? Interpolation::Linear : Interpolation::CatmullRom;
    double time = random.uniform(-1, 1);
    for (std::uint64_t keys = 1 + random.below(6); keys > 0; --keys) {
        Camera camera;
        const double size = std::pow(10, random.uniform(-6, 9));
        for (int axis = 0; axis < 3; ++axis) {
            camera.eye[axis] = random.uniform(-1, 1) * size;
            camera.target[axis] = random.uniform(-1, 1) * size;
            camera.up[axis] = random.uniform(-1, 1);
        }
        camera.fovYRadians = random.uniform(0.001, 3.14);
        path.keyframes.push_back({time, camera});
        time += random.uniform(0, 2);
    }
    return path;
}

TEST(CameraFiles, ReadBackWhatWasWrittenToTheLastBit) {
    Random random(1);
    for (int trial = 0; trial < 300; ++trial) {
        const CameraPath path = anyPath(random);
        const CameraPath read = fromText(toJson(path), readCameraPath);
        EXPECT_EQ(read.loop, path.loop);
        EXPECT_EQ(read.interpolation, path.interpolation);
        ASSERT_EQ(read.keyframes.size(), path.keyframes.size());
        for (std::size_t i = 0; i < path.keyframes.size(); ++i) {
            const Camera& a = read.keyframes[i].camera;
            const Camera& b = path.keyframes[i].camera;
            EXPECT_EQ(read.keyframes[i].time, path.keyframes[i].time);
            EXPECT_TRUE(a.eye == b.eye && a.target == b.target && a.up == b.up);
            EXPECT_NEAR(a.fovYRadians, b.fovYRadians, 1e-15 * b.fovYRadians + 1e-16);
        }
        EXPECT_EQ(toJson(read), toJson(path)) << "written again it is the same";
        EXPECT_EQ(contentHash(read), contentHash(path));
    }
}

TEST(CameraFiles, OfSavedViewsMixProjectionsAndAreRefusedWithTheirPlace) {
    Random random(4);
    SavedViews views{"/a \"model\".gnm", {}};
    EXPECT_TRUE(fromText(toJson(views), readViews).cameras.empty());
    for (const Keyframe& key : anyPath(random).keyframes)
        views.cameras.push_back(key.camera);
    views.cameras.push_back(views.cameras.front());
    views.cameras.back().projection = Projection::Orthographic;
    const SavedViews read = fromText(toJson(views), readViews);
    EXPECT_EQ(read.model, views.model);
    EXPECT_EQ(read.cameras.size(), views.cameras.size());
    EXPECT_EQ(toJson(read), toJson(views));
    ordered_json wrong = ordered_json::parse(toJson(views));
    wrong["views"][1].erase("eye");
    try {
        fromText(wrong.dump(), readViews);
        ADD_FAILURE() << "a view without an eye";
    } catch (const Error& error) {
        EXPECT_TRUE(std::string(error.what()).starts_with(filePath() + ": view 1")) << error.what();
    }
}

TEST(CameraFiles, HoldTheProjection) {
    Random random(3);
    CameraPath path = anyPath(random);
    EXPECT_EQ(toJson(path).find("projection"), std::string::npos) << "perspective files stay as they were";
    const CameraPath parallel = projected(path, Projection::Orthographic);
    EXPECT_EQ(toJson(projected(parallel, std::nullopt)), toJson(parallel));
    EXPECT_NE(contentHash(parallel), contentHash(path));
    const CameraPath read = fromText(toJson(parallel), readCameraPath);
    EXPECT_EQ(toJson(read), toJson(parallel));
    const double middle = read.keyframes.front().time + 0.5 * read.duration();
    EXPECT_TRUE(cameraAt(read, middle).isParallel());
    const Camera& camera = parallel.keyframes.front().camera;
    EXPECT_EQ(toJson(fromText(toJson(camera), readCamera)), toJson(camera));
    EXPECT_TRUE(
        objection(changed([](ordered_json& frame) { frame["projection"] = "orthographic"; })).starts_with(kPlace))
        << "one of three";
    for (const ordered_json& wrong : {ordered_json(3), ordered_json("isometric"), ordered_json(nullptr)})
        EXPECT_TRUE(objection(changed([&](ordered_json& frame) { frame["projection"] = wrong; })).starts_with(kPlace));
}

TEST(CameraFiles, HashToWhatTheySayAndNotToHowTheyAreWritten) {
    Random random(2);
    std::set<std::string> hashes;
    for (int trial = 0; trial < 100; ++trial) {
        CameraPath path = anyPath(random);
        const std::string hash = contentHash(path);
        EXPECT_EQ(hash.size(), 16U);
        EXPECT_EQ(hash.find_first_not_of("0123456789abcdef"), std::string::npos) << hash;
        EXPECT_TRUE(hashes.insert(hash).second);
        const std::string spaced = ordered_json::parse(toJson(path)).dump(7);
        EXPECT_EQ(contentHash(fromText(spaced, readCameraPath)), hash);
        path.loop = !path.loop;
        EXPECT_NE(contentHash(path), hash);
        path.loop = !path.loop;
        path.keyframes.back().camera.eye.z = std::nextafter(path.keyframes.back().camera.eye.z, 1e300);
        EXPECT_NE(contentHash(path), hash) << "by a single bit";
    }
}

} // namespace
} // namespace gnomon::path
