// The triangle mesh of one cut of a model. A cut consists of clusters that cover the whole surface once.
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
