#include "preprocess/simplify/simplify.h"

namespace gnomon::simplify {

SimplifiedPatch simplify(const Patch& patch, std::size_t targetTriangles, Simplifier simplifier) {
    switch (simplifier) {
    case Simplifier::Meshopt:
        return simplifyMeshopt(patch, targetTriangles);
    case Simplifier::OpenMesh:
        return simplifyOpenMesh(patch, targetTriangles);
    case Simplifier::Quadric:
        break;
    }
    return simplifyQuadric(patch, targetTriangles);
}

} // namespace gnomon::simplify
