#include "limn/record_sink.h"

#include <limits>
#include <utility>

#include "limn/core/error.h"

namespace limn {

namespace {

// The row of `object` in a table that keeps one row for each address; `append` makes a new one.
template <class Id, class Append>
Id row_of(std::unordered_map<const void*, Id>& rows, const void* object, const Append& append) {
    if (const auto known = rows.find(object); known != rows.end()) return known->second;
    const Id id = append();
    rows.emplace(object, id);
    return id;
}

std::uint32_t next_row(std::size_t size) {
    if (size >= std::numeric_limits<std::uint32_t>::max() - 1) throw ArgumentError("scene: too many objects");
    return static_cast<std::uint32_t>(size);
}

}  // namespace

MaterialId RecordSink::material(const std::shared_ptr<const void>& object,
                                const std::function<MaterialRecord()>& describe) {
    if (!object) return MaterialId::none;
    return row_of(materials_, object.get(), [&] {
        const MaterialRecord record = describe();
        keep(object);
        records_.materials.push_back(record);
        return MaterialId{next_row(records_.materials.size() - 1)};
    });
}

TextureId RecordSink::texture(const std::shared_ptr<const void>& object,
                              const std::function<TextureRecord()>& describe) {
    if (!object) return TextureId::none;
    return row_of(textures_, object.get(), [&] {
        const TextureRecord record = describe();
        keep(object);
        records_.textures.push_back(record);
        return TextureId{next_row(records_.textures.size() - 1)};
    });
}

std::uint32_t RecordSink::image(const std::shared_ptr<const Image>& image) {
    return row_of(images_, image.get(), [&] {
        records_.images.push_back(image);
        return next_row(records_.images.size() - 1);
    });
}

std::uint32_t RecordSink::lattice(const std::shared_ptr<const PerlinLattice>& lattice) {
    return row_of(lattices_, lattice.get(), [&] {
        records_.lattices.push_back(lattice);
        return next_row(records_.lattices.size() - 1);
    });
}

void RecordSink::sphere(const SphereRecord& record) {
    const bool moving = !(record.center0 == record.center1);
    append(moving ? PrimitiveKind::moving_sphere : PrimitiveKind::sphere, records_.spheres.size(), 1);
    records_.spheres.push_back(record);
}

void RecordSink::triangle(const TriangleRecord& record) {
    append(PrimitiveKind::triangle, records_.triangles.size(), 1);
    records_.triangles.push_back(record);
}

void RecordSink::quad(const QuadRecord& record) {
    append(PrimitiveKind::quad, records_.quads.size(), 1);
    records_.quads.push_back(record);
}

void RecordSink::mesh(MeshRecord record, const std::shared_ptr<const void>& owner) {
    record.owner = owner;
    append(PrimitiveKind::mesh, records_.meshes.size(), record.arrays.triangles.size());
    records_.meshes.push_back(std::move(record));
}

void RecordSink::foreign(const ForeignRecord& record) {
    append(PrimitiveKind::foreign, records_.foreign.size(), 1);
    records_.foreign.push_back(record);
}

void RecordSink::instance(const InstanceRecord& record) {
    append(PrimitiveKind::instance, records_.instances.size(),
           records_.groups[static_cast<std::size_t>(record.group)].primitives);
    records_.instances.push_back(record);
}

void RecordSink::medium(const MediumRecord& record) {
    append(PrimitiveKind::medium, records_.media.size(),
           records_.groups[static_cast<std::size_t>(record.boundary)].primitives);
    records_.media.push_back(record);
}

GroupId RecordSink::group(const std::shared_ptr<const void>& object, const std::function<void(RecordSink&)>& fill) {
    if (const auto known = groups_.find(object.get()); known != groups_.end()) {
        if (known->second.open) throw ArgumentError("scene: an object contains itself");
        return known->second.id;
    }
    const GroupId id{next_row(records_.groups.size())};
    keep(object);
    records_.groups.emplace_back();
    groups_.emplace(object.get(), GroupState{id, true});
    const std::size_t outer = std::exchange(current_, static_cast<std::size_t>(id));
    fill(*this);
    current_ = outer;
    groups_.at(object.get()).open = false;
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
    GroupRecord& group = records_.groups[current_];
    const std::uint64_t first_number = group.primitives;
    if (count > std::numeric_limits<std::uint64_t>::max() / 2 - first_number)
        throw ArgumentError("scene: too many primitives");
    group.primitives += count;
    const bool one_row =
        kind == PrimitiveKind::mesh || kind == PrimitiveKind::instance || kind == PrimitiveKind::medium;
    if (!one_row && !group.ranges.empty()) {
        PrimitiveRange& last = group.ranges.back();
        if (last.kind == kind && last.first_row + last.count == row) {
            ++last.count;
            return;
        }
    }
    group.ranges.push_back({kind, next_row(row), first_number, count});
}

}  // namespace limn
