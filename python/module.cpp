// gnomon._gnomon: the library as Python has it; gnomon/__init__.py is what people use.
#include "gnomon.h"

#include <utility>
#include <vector>

#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

namespace py = pybind11;
namespace api = gnomon::api;

namespace {

/// `values` as an array of rows of `width` that owns them; nothing is copied.
template <class T>
py::array_t<T> arrayOf(std::vector<T>&& values, std::vector<py::ssize_t> shape) {
    auto* owned = new std::vector<T>(std::move(values));
    const py::capsule owner(owned, [](void* data) { delete static_cast<std::vector<T>*>(data); });
    return py::array_t<T>(std::move(shape), owned->data(), owner);
}

template <class T>
py::array_t<T> rowsOf(std::vector<T>&& values, py::ssize_t width) {
    const auto rows = static_cast<py::ssize_t>(values.size()) / width;
    return arrayOf(std::move(values), {rows, width});
}

/// What `work` returns, made without the interpreter's lock.
template <class Work>
auto unlocked(const Work& work) {
    const py::gil_scoped_release release;
    return work();
}

py::tuple arraysOf(api::Mesh mesh) {
    return py::make_tuple(
        rowsOf(std::move(mesh.positions), 3),
        rowsOf(std::move(mesh.triangles), 3),
        rowsOf(std::move(mesh.normals), 3),
        rowsOf(std::move(mesh.colors), 4),
        mesh.error);
}

py::list schemes(double near, double far, double fovY, double aspect, const std::array<double, 3>& light) {
    py::list rows;
    for (const api::ShadowScheme& scheme : api::shadowSchemes(near, far, fovY, aspect, light)) {
        py::dict row;
        row["scheme"] = scheme.scheme;
        row["warp"] = scheme.warp;
        row["slices"] = scheme.slices;
        row["maps"] = scheme.maps;
        row["storage_factor"] = scheme.storageFactor;
        row["worst_across"] = scheme.worstAcross;
        row["worst_along"] = scheme.worstAlong;
        rows.append(row);
    }
    return rows;
}

using Tell = std::function<bool(const std::string&, std::uint64_t, std::uint64_t)>;

/// Progress that asks Python only now and then, and lets Ctrl-C end the work.
api::OnProgress progressOf(const Tell& tell) {
    return [tell](const std::string& stage, std::uint64_t done, std::uint64_t total) {
        const py::gil_scoped_acquire acquire;
        if (PyErr_CheckSignals() != 0) return false;
        return !tell || tell(stage, done, total);
    };
}

/// `api::build`; what Python raised meanwhile, an interrupt too, goes on as it was.
std::string build(
    const std::vector<std::string>& inputs,
    const std::string& output,
    const api::BuildOptions& options,
    const Tell& tell) {
    const api::OnProgress progress = progressOf(tell);
    try {
        return unlocked([&] { return api::build(inputs, output, options, progress); });
    } catch (const std::runtime_error&) {
        if (PyErr_Occurred() != nullptr) throw py::error_already_set();
        throw;
    }
}

void bindBuild(py::module_& module) {
    py::class_<api::BuildOptions>(module, "BuildOptions")
        .def(py::init<>())
        .def_readwrite("memory", &api::BuildOptions::memory)
        .def_readwrite("threads", &api::BuildOptions::threads)
        .def_readwrite("tmp", &api::BuildOptions::temporaryFolder)
        .def_readwrite("fields", &api::BuildOptions::fields)
        .def_readwrite("source_root", &api::BuildOptions::sourceRoot)
        .def_readwrite("up", &api::BuildOptions::up)
        .def_readwrite("unit", &api::BuildOptions::unit);
    module.def("build", &build);
}

void bindModel(py::module_& module) {
    py::class_<api::Model>(module, "Model")
        .def(py::init<const std::string&, std::uint64_t>())
        .def("info", &api::Model::info)
        .def(
            "plan",
            [](const api::Model& model, const api::Options& options) {
                return unlocked([&] { return model.plan(options); });
            })
        .def(
            "cut_by_error",
            [](const api::Model& model, double error) {
                return arraysOf(unlocked([&] { return model.cutByError(error); }));
            })
        .def(
            "cut_by_triangles",
            [](const api::Model& model, std::uint64_t maxTriangles) {
                return arraysOf(unlocked([&] { return model.cutByTriangles(maxTriangles); }));
            })
        .def(
            "cut_for_view",
            [](const api::Model& model, const api::Options& options) {
                return arraysOf(unlocked([&] { return model.cutForView(options); }));
            })
        .def(
            "render",
            [](const api::Model& model, const api::Options& options, int samples) {
                api::Picture picture = unlocked([&] { return model.render(options, samples); });
                return arrayOf(std::move(picture.pixels), {picture.height, picture.width, 4});
            })
        .def("damage", &api::Model::damage);
}

} // namespace

PYBIND11_MODULE(_gnomon, module) {
    module.def("version", &api::version);
    module.def("schemes", &schemes);
    bindBuild(module);
    bindModel(module);
}
