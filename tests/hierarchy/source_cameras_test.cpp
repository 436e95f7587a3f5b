// The cameras of a source, as a model stores them.
#include "core/error.h"
#include "core/random.h"
#include "hierarchy/model_file.h"
#include "hierarchy/model_text.h"
#include "hierarchy/source_cameras.h"
#include "tests/support/temporary_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace gnomon::hierarchy {
namespace {

/// A model file with `text` as its cameras, or without cameras if `text` is empty.
class ModelWithCameras {
public:
    explicit ModelWithCameras(const std::string& text) {
        tests::TinyModel model = tests::makeTinyModel({.gridExponent = 3});
        if (!text.empty()) model.summary.options[kCamerasOption] = text;
        tests::writeModel(model, file_.path());
    }

    ModelFile open() const { return ModelFile(file_.path()); }

private:
    tests::TemporaryModel file_{{.gridExponent = 3}, "cameras"};
};

TEST(SourceCameras, ComeBackToTheLastBit) {
    Random random(31);
    std::vector<Camera> cameras;
    for (int i = 0; i < 50; ++i) {
        Camera camera;
        for (glm::dvec3* vector : {&camera.eye, &camera.target, &camera.up})
            for (int axis = 0; axis < 3; ++axis)
                (*vector)[axis] = random.uniform(-1, 1) * std::pow(10, random.uniform(-9, 9));
        camera.fovYRadians = random.uniform(0.001, 3.1);
        camera.projection = i % 2 == 0 ? Projection::Perspective : Projection::Orthographic;
        cameras.push_back(camera);
    }
    const ModelFile model = ModelWithCameras(camerasText(cameras)).open();
    const std::vector<Camera> found = camerasOf(model);
    ASSERT_EQ(found.size(), cameras.size());
    EXPECT_EQ(cameraCount(model.summary()), cameras.size());
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        EXPECT_EQ(found[i].eye, cameras[i].eye);
        EXPECT_EQ(found[i].target, cameras[i].target);
        EXPECT_EQ(found[i].up, cameras[i].up);
        EXPECT_EQ(found[i].fovYRadians, cameras[i].fovYRadians);
        EXPECT_EQ(found[i].projection, cameras[i].projection);
    }
    const nlohmann::json told = nlohmann::json::parse(modelJson(model));
    EXPECT_EQ(told["cameras"], 50);
    EXPECT_FALSE(told["options"].contains(kCamerasOption));
    EXPECT_NE(modelText(model).find("\ncameras    50\n"), std::string::npos);
}

TEST(SourceCameras, AreNoneWhereNoneWereStored) {
    const ModelFile model = ModelWithCameras("").open();
    EXPECT_TRUE(camerasOf(model).empty());
    EXPECT_EQ(modelText(model).find("\ncameras "), std::string::npos);
    EXPECT_EQ(nlohmann::json::parse(modelJson(model))["cameras"], 0);
}

TEST(SourceCameras, DamagedTextIsRefused) {
    const std::string good = "perspective 0 0 5 0 0 0 0 1 0 1";
    EXPECT_EQ(camerasOf(ModelWithCameras(good + "\n").open()).size(), 1U);
    for (const std::string& text :
         {std::string("\n"),
          good + "\n\n",
          good + " 1\n",
          good + "x\n",
          good.substr(0, good.size() - 2),
          good + "\nfisheye" + good.substr(11),
          std::string("perspective 0 0 5 0 0 0 0 1 0 0"),
          std::string("perspective 0 0 5 0 0 0 0 1 0 4"),
          std::string("perspective 0 0 5 0 0 0 0 1 0 nan"),
          std::string("perspective 0 0 inf 0 0 0 0 1 0 1"),
          std::string("perspective 0 0 5 0 0 5 0 1 0 1"),
          std::string("perspective 0  5 0 0 0 0 1 0 1")}) {
        const ModelFile model = ModelWithCameras(text).open();
        EXPECT_THROW(camerasOf(model), Error) << text;
        EXPECT_NO_THROW(modelText(model)) << text;
    }
}

} // namespace
} // namespace gnomon::hierarchy
