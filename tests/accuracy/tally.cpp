#include "accuracy/tally.h"

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

namespace limn::accuracy {

namespace {
constexpr double kWorst = 1e300;  // JSON knows no infinity
}

void Cell::add(const Cell& other) {
    asked += other.asked;
    false_hits += other.false_hits, false_misses += other.false_misses;
    self_hits += other.self_hits, lost += other.lost, aborts += other.aborts;
    t_ulps = std::max(t_ulps, other.t_ulps);
    uv_ulps = std::max(uv_ulps, other.uv_ulps);
}

void Row::add(const Row& other) {
    rays += other.rays, judged += other.judged;
    for (std::size_t i = 0; i < cells.size(); ++i) cells[i].add(other.cells[i]);
}

std::uint64_t seed_of(const std::string& row, std::uint64_t chunk) {
    std::uint64_t h = 0xcbf29ce484222325;  // FNV-1a
    for (const char c : row) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    h += (chunk + 1) * 0x9e3779b97f4a7c15;  // SplitMix64 (Steele, Lea, Flood, OOPSLA 2014)
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9;
    h = (h ^ (h >> 27)) * 0x94d049bb133111eb;
    return h ^ (h >> 31);
}

Row add_up(const Row& empty, std::uint64_t rays, std::size_t size, unsigned threads,
           const std::function<Work()>& maker) {
    if (threads == 0) threads = std::max(1U, std::thread::hardware_concurrency());
    const std::uint64_t chunks = (rays + size - 1) / size;
    Row total = empty;
    std::atomic<std::uint64_t> next{0};
    std::mutex lock;
    std::exception_ptr problem;
    const auto run = [&] {
        try {
            Row sum = empty;
            const Work work = maker();
            for (std::uint64_t chunk; (chunk = next++) < chunks;)
                work(chunk, static_cast<std::size_t>(std::min<std::uint64_t>(size, rays - chunk * size)), sum);
            const std::lock_guard guard(lock);
            total.add(sum);
        } catch (...) {
            next = chunks;
            const std::lock_guard guard(lock);
            problem = std::current_exception();
        }
    };
    std::vector<std::thread> others;
    for (unsigned i = 1; i < threads && i < chunks; ++i) others.emplace_back(run);
    run();
    for (std::thread& thread : others) thread.join();
    if (problem) std::rethrow_exception(problem);
    return total;
}

double in_ulps_of_1(test::Real error) {
    const auto ulps = static_cast<double>(test::absolute(error) * test::Real(0x1p23));
    return ulps < kWorst ? ulps : kWorst;  // NaN too
}

double ulps(double t, test::Real truth) {
    if (truth == 0) return t == 0 ? 0 : kWorst;
    return in_ulps_of_1((test::Real(t) - truth) / truth);
}

}  // namespace limn::accuracy
