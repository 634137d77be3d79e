// Construction of objects from an argument that is a colour or a texture.
#pragma once

#include <nanobind/stl/shared_ptr.h>

#include <memory>
#include <utility>

#include "arguments.h"
#include "limn/scene/texture/texture.h"

namespace limn::python {

// Constructs a Made in `place` from the argument, a texture or a colour, and from `rest`. Throws an error that names
// the argument if it is neither.
template <class Made, class... Rest>
void make(void* place, ColorArgument argument, const char* name, const Rest&... rest) {
    std::shared_ptr<Texture> texture;
    if (!argument.object.is_none() && nb::try_cast(argument.object, texture))
        new (place) Made(std::shared_ptr<const Texture>(std::move(texture)), rest...);
    else
        new (place) Made(color(argument.object, name), rest...);
}

// Binds the materials with microfacets.
void bind_microfacets(nb::module_& module);

}  // namespace limn::python
