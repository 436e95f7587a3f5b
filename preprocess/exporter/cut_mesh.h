// The mesh of a cut of a model. A cut is, for example, one level of detail.
#pragma once

#include "hierarchy/model.h"
#include "hierarchy/page_fields.h"

#include <array>
#include <cstdint>
#include <vector>

namespace gnomon::exporter {

/// The vertices and triangles of a cut of a model.
struct CutMesh {
    std::vector<hierarchy::Vertex> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    hierarchy::PageFields fields; // quantised scalar fields of the vertices

    std::uint32_t fieldsOf(std::uint32_t vertex) const { return fields.words.empty() ? 0 : fields.words[vertex]; }
};

} // namespace gnomon::exporter
