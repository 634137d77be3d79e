/// \file
/// Where described objects write their records.
#pragma once

#include <functional>
#include <memory>
#include <unordered_map>
#include <unordered_set>

#include "limn/core/tagged.h"
#include "limn/records.h"

namespace limn {

/// What a described object writes its records to. Shared objects are described once: the second time the sink knows
/// their address and returns the same id. Not thread-safe; used by one compilation.
class RecordSink {
public:
    /// The id of a material or texture; `describe` is called the first time only. The sink keeps the object alive.
    /// A null object gives `none`.
    ///@{
    MaterialId material(const std::shared_ptr<const void>& object, const std::function<MaterialRecord()>& describe);
    TextureId texture(const std::shared_ptr<const void>& object, const std::function<TextureRecord()>& describe);
    ///@}

    /// The row of SceneRecords::images or SceneRecords::lattices. \pre not null
    ///@{
    std::uint32_t image(const std::shared_ptr<const Image>& image);
    std::uint32_t lattice(const std::shared_ptr<const PerlinLattice>& lattice);
    ///@}

    /// Adds a light that is no shape, or sets the environment.
    ///@{
    void light(const LightRecord& record) { records_.lights.push_back(record); }
    void environment(const EnvironmentRecord& record) { records_.environment = record; }
    ///@}

    /// Adds a shape to the current BLAS. Its ids must be the sink's own. What a record points to must stay alive: a
    /// mesh's arrays as long as `owner`; a user-defined shape as long as the scene, which keeps what was added to it
    /// and for what BLASes hold. \throws ArgumentError if there are too many primitives
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

    /// The same for any kind. `table` has its records, `count` is the number of primitives.
    template <class Record>
    void shape(PrimitiveKind kind, std::vector<Record> SceneRecords::*table, const Record& record,
               std::uint64_t count = 1) {
        append(kind, (records_.*table).size(), count);
        (records_.*table).push_back(record);
    }

    /// A BLAS that instances and media refer to: `fill` writes its shapes, the first time only.
    /// \throws ArgumentError if an object contains itself
    BlasId blas(const std::shared_ptr<const void>& object, const std::function<void(RecordSink&)>& fill);

    /// The tag of a user-defined object, if it has one; null: it has none.
    void identify(const Tagged* object);

    /// Around the description of an object that contains others.
    /// \throws ArgumentError if it is being described already
    ///@{
    void enter(const void* object);
    void leave(const void* object);
    ///@}

    /// Keeps the owner of something that a record points to alive as long as the records.
    void keep(const std::shared_ptr<const void>& owner);

    /// Primitives in the current BLAS so far.
    std::uint64_t primitives() const { return records_.blases[current_].primitives; }
    const SceneRecords& records() const { return records_; }  ///< what was written so far
    SceneRecords take() && { return std::move(records_); }    ///< ends the sink

private:
    void append(PrimitiveKind kind, std::size_t row, std::uint64_t count);

    SceneRecords records_;
    std::size_t current_ = 0;
    std::unordered_map<const void*, MaterialId> materials_;
    std::unordered_map<const void*, TextureId> textures_;
    std::unordered_map<const void*, std::uint32_t> images_, lattices_;
    struct BlasState {
        BlasId id;
        bool open;
    };
    std::unordered_map<const void*, BlasState> blases_;
    std::unordered_set<const void*> entered_;
};

}  // namespace limn
