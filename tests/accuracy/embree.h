// Embree, asked in a child process, because Debian's build ends the process on some rays.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "accuracy/question.h"

namespace limn::accuracy {

struct EmbreeTalk;

class Embree {
public:
    // Whether the child's program was built, that is, whether Embree was there when limn was configured.
    static bool is_there();

    Embree();
    ~Embree();
    Embree(const Embree&) = delete;
    Embree& operator=(const Embree&) = delete;

    // Replaces the scene. \pre the geometry fits in EmbreeTalk
    void set(const Geometry& geometry);

    // Starts on at most kBatch rays; finish() waits for the answers: of the default mode, then of the robust one. A ray
    // that ends the child is answered `aborted`, and a new child goes on with the next.
    void start(std::span<const Ray> rays);
    void finish(std::vector<Answer>& plain, std::vector<Answer>& robust);

private:
    void spawn();
    void reap();
    void order(char what) const;
    bool wait() const;  // false: the child has died

    EmbreeTalk* talk_;
    int memory_, to_child_ = -1, from_child_ = -1, child_ = -1;
};

}  // namespace limn::accuracy
