#include "preprocess/build/simplify.h"

namespace gnomon::preprocess {

SimplifiedPatch simplify(const Patch& patch, std::size_t targetTriangles, Simplifier /*simplifier*/) {
    return simplifyOwn(patch, targetTriangles);
}

} // namespace gnomon::preprocess
