// Construction of .glb files in code.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace gnomon::read {

/// A file that is built accessor by accessor.
class GltfMaker {
public:
    using json = nlohmann::json;

    json document = {
        {"asset", {{"version", "2.0"}}},
        {"scene", 0},
        {"scenes", {{{"nodes", {0}}}}},
        {"nodes", {{{"mesh", 0}}}},
        {"meshes", {{{"primitives", {{{"attributes", json::object()}}}}}}}};

    template <class T>
    int add(const std::vector<T>& values, const char* type, int componentType, std::size_t components) {
        while (bytes_.size() % 4 != 0)
            bytes_ += '\0';
        const std::string_view raw(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
        document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", raw.size()}});
        bytes_ += raw;
        document["accessors"].push_back(
            {{"bufferView", document["bufferViews"].size() - 1},
             {"componentType", componentType},
             {"count", values.size() / components},
             {"type", type}});
        return static_cast<int>(document["accessors"].size()) - 1;
    }

    int addVectors(const std::vector<float>& values, int components = 3) {
        const std::string type = "VEC" + std::to_string(components);
        return add(values, type.c_str(), 5126, static_cast<std::size_t>(components));
    }

    json& attributes() { return document["meshes"][0]["primitives"][0]["attributes"]; }

    json& primitive() { return document["meshes"][0]["primitives"][0]; }

    /// Returns the file as a .glb.
    std::string container() { return containerWith({{{"byteLength", bytes_.size()}}}); }

    /// Returns the file as a .glb whose document lists these buffers.
    std::string containerWith(const json& buffers) {
        document["buffers"] = buffers;
        std::string text = document.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        std::string binary = bytes_;
        binary.resize((binary.size() + 3) / 4 * 4, '\0');
        const auto word = [](std::uint64_t value) {
            const auto part = static_cast<std::uint32_t>(value);
            std::string raw(4, '\0');
            std::memcpy(raw.data(), &part, 4);
            return raw;
        };
        return "glTF" + word(2) + word(28 + text.size() + binary.size()) + word(text.size()) + "JSON" + text +
               word(binary.size()) + std::string("BIN\0", 4) + binary;
    }

private:
    std::string bytes_;
};

} // namespace gnomon::read
