/// \file
/// Names for what user-defined objects are.
#pragma once

#include <string>

namespace limn {

/// What a user-defined shape, material or texture may also derive from, so that films (render/film.h) tell its scenes
/// apart and can be continued by other programs.
class Tagged {
public:
    virtual ~Tagged() = default;

    /// Other for objects that answer otherwise: the name and version of the class, and all its parameters, those of a
    /// shape's materials included.
    virtual std::string tag() const = 0;
};

}  // namespace limn
