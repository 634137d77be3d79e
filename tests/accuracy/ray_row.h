// A row of a table: chunks of random rays at random geometries, or at one that stays, put to every column.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "accuracy/subject.h"
#include "accuracy/tally.h"

namespace limn::accuracy {

struct RayRow {
    std::string name;
    double x = 0;  // where plots put the row
    // A new geometry for each chunk of rays, or, where there is none, `fixed`.
    std::function<Geometry(test::Random&)> geometry{};
    std::shared_ptr<const Subject> fixed{};
    std::function<Ray(test::Random&, const Geometry&)> ray;
    // Every ray is known to hit, so that the truth is asked only for rays that somebody misses.
    bool must_hit = false;
    // Rays like these end Embree's process: it is asked a few of them only.
    bool lethal = false;
    // hit() of a large mesh asks every triangle: too slow for this row.
    bool without_hit = false;
    std::size_t chunk = kBatch;
    double share = 1;  // of the rays that the table's rows get
};

// Asks all columns about `rays` rays and judges every answer.
Row measure(const RayRow& row, const std::vector<Column>& columns, std::uint64_t rays, unsigned threads);

// The whole table, with progress on stderr. Columns of Embree are left out where there is none.
Group measure(const std::string& key, const std::string& measure_name, std::vector<Column> columns,
              const std::vector<RayRow>& rows, std::uint64_t rays, unsigned threads);

void note(const std::string& text);  // on stderr

}  // namespace limn::accuracy
