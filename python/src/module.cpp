// The module limn._limn. The public names of it are re-exported by limn/__init__.py.
#include <nanobind/nanobind.h>

#include "bindings.h"
#include "limn/math/error.h"
#include "limn/render/render.h"
#include "queries.h"

NB_MODULE(_limn, module) {
    namespace nb = nanobind;
    using namespace limn::python;

    module.doc() = "The compiled part of the package limn. Import limn instead.";
    module.attr("__version__") = limn::version();
    module.attr("INVALID_ID") = kInvalidId;
    // Translate limn's exceptions to Python's.
    nb::register_exception_translator([](const std::exception_ptr& raised, void*) {
        try {
            std::rethrow_exception(raised);
        } catch (const limn::ArgumentError& error) {
            PyErr_SetString(PyExc_ValueError, error.what());
        } catch (const limn::FileError& error) {
            PyErr_SetString(PyExc_OSError, error.what());
        } catch (const limn::Error& error) {
            PyErr_SetString(PyExc_RuntimeError, error.what());
        }
    });
    // Bind the classes and functions.
    bind_textures(module);
    bind_materials(module);
    bind_shapes(module);
    bind_meshes(module);
    bind_lights(module);
    bind_scene(module);
    bind_images(module);
    bind_render(module);
}
