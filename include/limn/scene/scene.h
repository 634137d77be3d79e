/// \file
/// What is described.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "limn/scene/background.h"
#include "limn/scene/model.h"
#include "limn/shape/hittable.h"

namespace limn {

/// A description: objects and a background. Filling it is not thread-safe, reading it is.
class Scene {
public:
    Background background = Background::black();  ///< by default no light but that of lamps
    std::string name = "scene";                   ///< goes into reports and picture headers

    /// Returns the object's number, counted from 0. \throws ArgumentError if it is null
    std::size_t add(std::shared_ptr<const Hittable> object);
    /// Adds each instance of the model as an object. Returns the number of the first; the others follow in order.
    std::size_t add(const Model& model);
    const std::vector<std::shared_ptr<const Hittable>>& objects() const { return objects_; }  ///< by number
    Box bounds() const;  ///< around all objects over the whole shutter

private:
    std::vector<std::shared_ptr<const Hittable>> objects_;
};

}  // namespace limn
