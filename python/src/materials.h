// Materials of a colour or a texture.
#pragma once

#include <nanobind/stl/shared_ptr.h>

#include <memory>
#include <utility>

#include "arguments.h"
#include "limn/texture/texture.h"

namespace limn::python {

template <class Made, class... Rest>
void make(void* place, ColorArgument argument, const char* name, const Rest&... rest) {
    std::shared_ptr<Texture> texture;
    if (!argument.object.is_none() && nb::try_cast(argument.object, texture))
        new (place) Made(std::shared_ptr<const Texture>(std::move(texture)), rest...);
    else
        new (place) Made(color(argument.object, name), rest...);
}

void bind_microfacets(nb::module_& module);

}  // namespace limn::python
