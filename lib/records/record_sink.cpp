#include "limn/records/record_sink.h"

#include <limits>
#include <utility>

#include "limn/math/error.h"

namespace limn {

namespace {

// Returns the id of the next row of a table. Throws ArgumentError if the table is full.
std::uint32_t next_row(std::size_t size) {
    if (size >= std::numeric_limits<std::uint32_t>::max() - 1) throw ArgumentError("scene: too many objects");
    return static_cast<std::uint32_t>(size);
}

// Returns the row of `object` in a table with one row for each address. Calls `describe` to make a new row.
template <class Id, class Row, class Describe>
Id row_of(std::unordered_map<const void*, Id>& known, std::vector<Row>& table, const void* object,
          const Describe& describe) {
    if (const auto row = known.find(object); row != known.end()) return row->second;
    table.push_back(describe());  // describe() may add rows of other objects before this one
    const Id id{next_row(table.size() - 1)};
    known.emplace(object, id);
    return id;
}

}  // namespace

MaterialId RecordSink::material(const std::shared_ptr<const void>& object,
                                const std::function<MaterialRecord()>& describe) {
    if (!object) return MaterialId::none;
    return row_of(materials_, records_.materials, object.get(), [&] {
        keep(object);
        return describe();
    });
}

TextureId RecordSink::texture(const std::shared_ptr<const void>& object,
                              const std::function<TextureRecord()>& describe) {
    if (!object) return TextureId::none;
    return row_of(textures_, records_.textures, object.get(), [&] {
        keep(object);
        return describe();
    });
}

std::uint32_t RecordSink::image(const std::shared_ptr<const Image>& image) {
    return row_of(images_, records_.images, image.get(), [&] { return image; });
}

std::uint32_t RecordSink::lattice(const std::shared_ptr<const PerlinLattice>& lattice) {
    return row_of(lattices_, records_.lattices, lattice.get(), [&] { return lattice; });
}

void RecordSink::mesh(MeshRecord record, const std::shared_ptr<const void>& owner) {
    record.owner = owner;
    shape(PrimitiveKind::mesh, &SceneRecords::meshes, record, record.arrays.triangles.size());
}

void RecordSink::instance(const InstanceRecord& record) {
    shape(PrimitiveKind::instance, &SceneRecords::instances, record,
          records_.blases[static_cast<std::size_t>(record.blas)].primitives);
}

void RecordSink::medium(const MediumRecord& record) {
    shape(PrimitiveKind::medium, &SceneRecords::media, record,
          records_.blases[static_cast<std::size_t>(record.boundary)].primitives);
}

BlasId RecordSink::blas(const std::shared_ptr<const void>& object, const std::function<void(RecordSink&)>& fill) {
    if (const auto known = blases_.find(object.get()); known != blases_.end()) {
        if (known->second.open) throw ArgumentError("scene: an object contains itself");
        return known->second.id;
    }
    const BlasId id{next_row(records_.blases.size())};
    keep(object);
    records_.blases.emplace_back();
    blases_.emplace(object.get(), BlasState{id, true});
    const std::size_t outer = std::exchange(current_, static_cast<std::size_t>(id));
    fill(*this);
    current_ = outer;
    blases_.at(object.get()).open = false;
    return id;
}

void RecordSink::identify(const Tagged* object) {
    if (object)
        records_.tags.push_back(object->tag());
    else
        records_.untagged = true;
}

void RecordSink::enter(const void* object) {
    if (!entered_.insert(object).second) throw ArgumentError("scene: an object contains itself");
}

void RecordSink::leave(const void* object) { entered_.erase(object); }

void RecordSink::keep(const std::shared_ptr<const void>& owner) { records_.kept.push_back(owner); }

void RecordSink::append(PrimitiveKind kind, std::size_t row, std::uint64_t count) {
    BlasRecord& blas = records_.blases[current_];
    const std::uint64_t first_number = blas.primitives;
    if (count > std::numeric_limits<std::uint64_t>::max() / 2 - first_number)
        throw ArgumentError("scene: too many primitives");
    blas.primitives += count;
    const bool one_row =
        kind == PrimitiveKind::mesh || kind == PrimitiveKind::instance || kind == PrimitiveKind::medium;
    if (!one_row && !blas.ranges.empty()) {
        PrimitiveRange& last = blas.ranges.back();
        if (last.kind == kind && last.first_row + last.count == row) {
            ++last.count;
            return;
        }
    }
    blas.ranges.push_back({kind, next_row(row), first_number, count});
}

}  // namespace limn
