#include "app/option_errors.h"

#include "settings/table.h"

namespace gnomon::app {

Error inOptions(const LimitError& error) {
    const LimitError::Parts& parts = error.parts();
    switch (error.limit()) {
    case Limit::Memory:
        return {parts.where, parts.what, "--memory " + parts.expected, parts.found};
    case Limit::ChunkTriangles:
        return {"--chunk-triangles", "too few for this model", parts.expected, parts.found};
    case Limit::IrreducibleTriangles:
        return {"--max-stuck", parts.what, parts.expected, parts.found};
    case Limit::Textures:
        return {parts.where, parts.what, parts.expected + ", or --textures off", parts.found};
    case Limit::SourceRoot:
        return {parts.where, parts.what, parts.expected + " (--source-root allows another folder)", parts.found};
    default:
        return Error(error.what() + ("; see " + settings::optionsOf(error.limits())));
    }
}

} // namespace gnomon::app
