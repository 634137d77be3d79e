/// \file
/// Names for user-defined objects.
#pragma once

#include <string>

namespace limn {

/// A user-defined shape, material or texture may also derive from this. Then films (render/film.h) tell its scenes
/// apart, and other programs can continue them (docs/extending.md).
class Tagged {
public:
    virtual ~Tagged() = default;

    /// The name and version of the class, and all its parameters, those of a shape's materials included. It differs
    /// between objects whose results differ.
    virtual std::string tag() const = 0;
};

}  // namespace limn
