/// \file
/// Tags that tell user-defined objects apart.
#pragma once

#include <string>

namespace limn {

/// A base class that a user-defined shape, material or texture may have in addition. Its tag enters
/// CompiledScene::digest, by which films (limn/render/film.h) tell scenes apart. A film of a scene with an untagged
/// object can be continued only by the program that made it (docs/extending.md).
class Tagged {
public:
    virtual ~Tagged() = default;

    /// Returns the name and version of the class and all its parameters. The tag of a shape includes the parameters of
    /// its materials. Tags of objects whose results differ must differ.
    virtual std::string tag() const = 0;
};

}  // namespace limn
