#include "accuracy/ray_row.h"

#include <cstdio>

#include "accuracy/embree.h"

namespace limn::accuracy {

namespace {

bool is_embree(Column column) { return column == Column::embree || column == Column::embree_robust; }

constexpr std::size_t kLethal = 32;  // rays of a lethal row that Embree is asked: each may cost it a process

bool has_uv(Column column) { return column == Column::limn || column == Column::limn_hit || is_embree(column); }

// What one thread needs: a child of its own that asks Embree, and room for answers.
class Questioner {
public:
    Questioner(const RayRow& row, const std::vector<Column>& columns)
        : row_(row), columns_(columns), answers_(columns.size()), asked_(columns.size()) {
        const auto needs_near = [](Column c) { return c == Column::moeller_trumbore || c == Column::pluecker; };
        wants_near_ = std::any_of(columns.begin(), columns.end(), needs_near);
        if (std::any_of(columns.begin(), columns.end(), is_embree)) embree_ = std::make_unique<Embree>();
        if (embree_ && row.fixed) embree_->set(row.fixed->geometry());
    }

    void operator()(std::uint64_t chunk, std::size_t count, Row& sum) {
        test::Random random(seed_of(row_.name, chunk));
        std::shared_ptr<const Subject> subject = row_.fixed;
        if (!subject) subject = std::make_shared<const Subject>(row_.geometry(random));
        rays_.clear();
        for (std::size_t i = 0; i < count; ++i) rays_.push_back(row_.ray(random, subject->geometry()));
        sum.rays += count;

        const std::size_t for_embree = !row_.lethal ? count : chunk == 0 ? std::min(count, kLethal) : 0;
        for (std::size_t k = 0; k < columns_.size(); ++k) {
            asked_[k] = is_embree(columns_[k])                                ? for_embree
                        : columns_[k] == Column::limn_hit && row_.without_hit ? 0
                                                                              : count;
            sum.cells[k].asked += asked_[k];
        }
        const bool with_embree = embree_ && for_embree > 0;
        if (with_embree) {
            if (!row_.fixed) embree_->set(subject->geometry());
            embree_->start({rays_.data(), for_embree});  // it works on while we do
        }
        if (wants_near_) subject->find_near(rays_, near_);
        for (std::size_t k = 0; k < columns_.size(); ++k)
            if (asked_[k] > 0 && !is_embree(columns_[k])) subject->ask(columns_[k], rays_, near_, answers_[k]);
        if (with_embree) {
            embree_->finish(plain_, robust_);
            for (std::size_t k = 0; k < columns_.size(); ++k)
                if (is_embree(columns_[k])) answers_[k].swap(columns_[k] == Column::embree ? plain_ : robust_);
        }
        for (std::size_t i = 0; i < count; ++i) judge(*subject, i, sum);
    }

private:
    void judge(const Subject& subject, std::size_t i, Row& sum) {
        ++sum.judged;
        if (row_.must_hit) return judge_leak(subject, i, sum);
        const Subject::Truth truth = subject.truth(rays_[i]);
        for (std::size_t k = 0; k < columns_.size(); ++k) {
            if (i >= asked_[k]) continue;
            const Answer& answer = answers_[k][i];
            Cell& cell = sum.cells[k];
            if (answer.aborted) {
                ++cell.aborts;
            } else if (answer.hit() != truth.hit.hit) {
                ++(truth.hit.hit ? cell.false_misses : cell.false_hits);
            } else if (answer.hit()) {
                cell.t_ulps = std::max(cell.t_ulps, ulps(answer.t, truth.hit.t));
                if (!has_uv(columns_[k]) || subject.geometry().radius > 0 || answer.primitive != truth.primitive)
                    continue;
                for (const test::Real off : {answer.u - truth.hit.u, answer.v - truth.hit.v})
                    cell.uv_ulps = std::max(cell.uv_ulps, in_ulps_of_1(off));
            }
        }
    }

    // One exact hit of a triangle that somebody names proves that the ray hits; else all that are near are asked.
    void judge_leak(const Subject& subject, std::size_t i, Row& sum) {
        const auto missed = [i](const std::vector<Answer>& answers) { return !answers[i].hit(); };
        if (std::none_of(answers_.begin(), answers_.end(), missed)) return;
        const bool hits = std::any_of(answers_.begin(), answers_.end(),
                                      [&](const std::vector<Answer>& answers) {
                                          return answers[i].hit() && subject.truth(rays_[i], answers[i].primitive).hit;
                                      }) ||
                          subject.truth(rays_[i]).hit.hit;
        for (std::size_t k = 0; k < columns_.size(); ++k) {
            Cell& cell = sum.cells[k];
            if (answers_[k][i].hit() != hits) ++(hits ? cell.false_misses : cell.false_hits);
        }
    }

    const RayRow& row_;
    const std::vector<Column>& columns_;
    std::unique_ptr<Embree> embree_;
    std::vector<Ray> rays_;
    std::vector<std::vector<Answer>> answers_;  // a column each
    std::vector<std::size_t> asked_;            // the first so many of the chunk
    std::vector<Answer> plain_, robust_;
    bool wants_near_ = false;
    Subject::Near near_;
};

}  // namespace

void note(const std::string& text) { std::fprintf(stderr, "accuracy: %s\n", text.c_str()); }

Row measure(const RayRow& row, const std::vector<Column>& columns, std::uint64_t rays, unsigned threads) {
    Row empty;
    empty.name = row.name;
    empty.x = row.x;
    empty.cells.resize(columns.size());
    return add_up(empty, rays, row.chunk, threads, [&]() -> Work {
        return [asker = std::make_shared<Questioner>(row, columns)](std::uint64_t chunk, std::size_t count, Row& sum) {
            (*asker)(chunk, count, sum);
        };
    });
}

Group measure(const std::string& key, const std::string& measure_name, std::vector<Column> columns,
              const std::vector<RayRow>& rows, std::uint64_t rays, unsigned threads) {
    if (!Embree::is_there()) std::erase_if(columns, is_embree);
    Group group{key, measure_name, {}, {}};
    for (const Column column : columns) group.columns.push_back(name_of(column));
    for (const RayRow& row : rows) {
        note(key + ": " + row.name);
        group.rows.push_back(measure(
            row, columns, static_cast<std::uint64_t>(std::max(1.0, row.share * static_cast<double>(rays))), threads));
    }
    return group;
}

}  // namespace limn::accuracy
