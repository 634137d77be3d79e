/// \file
/// The sink that the objects of a Scene write their records to.
#pragma once

#include <functional>
#include <memory>
#include <unordered_map>
#include <unordered_set>

#include "limn/math/tagged.h"
#include "limn/records/records.h"

namespace limn {

/// Collects the records of one scene. Hittable::lower, Material::lower and Texture::lower write to it. A shared
/// material, texture, image, lattice or BLAS is described once: the sink recognises its address and returns the same id
/// again. Not thread-safe; each compilation has a sink of its own.
class RecordSink {
public:
    /// Returns the id of a material or texture. Calls `describe` for its record the first time only. The records keep
    /// the object alive. Returns `none` for a null object.
    ///
    /// \throws ArgumentError if there are too many materials or textures
    ///@{
    MaterialId material(const std::shared_ptr<const void>& object, const std::function<MaterialRecord()>& describe);
    TextureId texture(const std::shared_ptr<const void>& object, const std::function<TextureRecord()>& describe);
    ///@}

    /// Returns the row of the argument in SceneRecords::images or SceneRecords::lattices. The first call for an
    /// argument adds the row. \pre the argument is not null
    ///
    /// \throws ArgumentError if there are too many images or lattices
    ///@{
    std::uint32_t image(const std::shared_ptr<const Image>& image);
    std::uint32_t lattice(const std::shared_ptr<const PerlinLattice>& lattice);
    ///@}

    /// Adds a shape to the current BLAS, which is the scene itself except inside `blas`. The ids in the record must
    /// come from this sink. The arrays of a mesh must be valid while `owner` exists. A user-defined shape must exist
    /// while the compiled scene does, which keeps the objects of the Scene and the objects given to `blas` alive.
    ///
    /// \throws ArgumentError if there are too many primitives
    ///@{
    void sphere(const SphereRecord& record) {
        shape(record.center0 == record.center1 ? PrimitiveKind::sphere : PrimitiveKind::moving_sphere,
              &SceneRecords::spheres, record);
    }
    void triangle(const TriangleRecord& record) { shape(PrimitiveKind::triangle, &SceneRecords::triangles, record); }
    void quad(const QuadRecord& record) { shape(PrimitiveKind::quad, &SceneRecords::quads, record); }
    void user_defined(const UserDefinedRecord& record) {
        shape(PrimitiveKind::user_defined, &SceneRecords::user_defined, record);
    }
    void mesh(MeshRecord record, const std::shared_ptr<const void>& owner);
    void instance(const InstanceRecord& record);
    void medium(const MediumRecord& record);
    ///@}

    /// Adds a shape of any kind to the current BLAS. `table` is the table of its records.
    ///
    /// \param count number of its primitives
    ///
    /// \throws ArgumentError if there are too many primitives
    template <class Record>
    void shape(PrimitiveKind kind, std::vector<Record> SceneRecords::*table, const Record& record,
               std::uint64_t count = 1) {
        append(kind, (records_.*table).size(), count);
        (records_.*table).push_back(record);
    }

    /// Returns the BLAS of an object that instances or media refer to. Calls `fill` the first time only. While `fill`
    /// runs, this is the current BLAS, to which shapes are added. The records keep the object alive.
    ///
    /// \throws ArgumentError if an object contains itself, or there are too many BLASes
    BlasId blas(const std::shared_ptr<const void>& object, const std::function<void(RecordSink&)>& fill);

    /// Records the tag of a user-defined object. A null pointer records that an object has no tag.
    void identify(const Tagged* object);

    /// Mark the beginning and the end of the description of an object that contains other objects. The object calls
    /// `enter(this)` before it describes them and `leave(this)` afterwards. This detects an object that contains
    /// itself.
    ///
    /// \throws ArgumentError if the object contains itself: it was entered and not left
    ///@{
    void enter(const void* object);
    void leave(const void* object);
    ///@}

    /// Keeps `owner` alive while the records exist. A record may point to data that `owner` owns.
    void keep(const std::shared_ptr<const void>& owner);

    /// Returns the number of primitives that the current BLAS has so far.
    std::uint64_t primitives() const { return records_.blases[current_].primitives; }
    const SceneRecords& records() const { return records_; }  ///< records written so far
    SceneRecords take() && { return std::move(records_); }    ///< moves the records out

private:
    void append(PrimitiveKind kind, std::size_t row, std::uint64_t count);

    SceneRecords records_;
    std::size_t current_ = 0;  // row of the current BLAS
    // The ids and rows of objects that are described already, by address.
    std::unordered_map<const void*, MaterialId> materials_;
    std::unordered_map<const void*, TextureId> textures_;
    std::unordered_map<const void*, std::uint32_t> images_, lattices_;
    struct BlasState {
        BlasId id;
        bool open;  // true while `fill` is running
    };
    std::unordered_map<const void*, BlasState> blases_;
    std::unordered_set<const void*> entered_;
};

}  // namespace limn
