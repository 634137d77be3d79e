#include "accuracy/embree.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <string>

#include "accuracy/embree_protocol.h"
#include "limn/math/error.h"

extern char** environ;

namespace limn::accuracy {

namespace {

std::string child_program() {
    return (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "limn_accuracy_embree").string();
}

void check(bool works, const char* what) {
    if (!works) throw Error(std::string("limn_accuracy: ") + what + " failed");
}

}  // namespace

bool Embree::is_there() { return access(child_program().c_str(), X_OK) == 0; }

Embree::Embree() : memory_(memfd_create("embree", MFD_CLOEXEC)) {
    check(memory_ >= 0 && ftruncate(memory_, sizeof(EmbreeTalk)) == 0, "shared memory");
    void* const memory = mmap(nullptr, sizeof(EmbreeTalk), PROT_READ | PROT_WRITE, MAP_SHARED, memory_, 0);
    check(memory != MAP_FAILED, "mapping shared memory");
    talk_ = new (memory) EmbreeTalk;
    std::signal(SIGPIPE, SIG_IGN);  // a dead child is noticed when it does not answer
    spawn();
}

Embree::~Embree() {
    reap();
    munmap(talk_, sizeof(EmbreeTalk));
    close(memory_);
}

void Embree::spawn() {
    int down[2], up[2];
    check(pipe2(down, O_CLOEXEC) == 0 && pipe2(up, O_CLOEXEC) == 0, "a pipe");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    // The shared memory first moves out of the way of the numbers that it and the pipes are to have.
    const int memory = fcntl(memory_, F_DUPFD_CLOEXEC, 10);
    posix_spawn_file_actions_adddup2(&actions, down[0], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, up[1], STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);  // assertions fail loudly
    posix_spawn_file_actions_adddup2(&actions, memory, kSharedMemory);
    const std::string program = child_program();
    char* const arguments[] = {const_cast<char*>(program.c_str()), nullptr};
    check(posix_spawn(&child_, program.c_str(), &actions, nullptr, arguments, environ) == 0, "starting Embree's child");
    posix_spawn_file_actions_destroy(&actions);
    for (const int descriptor : {memory, down[0], up[1]}) close(descriptor);
    to_child_ = down[1], from_child_ = up[0];
}

void Embree::reap() {
    close(to_child_), close(from_child_);
    waitpid(child_, nullptr, 0);
}

void Embree::order(char what) const {
    [[maybe_unused]] const auto sent = write(to_child_, &what, 1);  // wait() notices a child that does not read
}

bool Embree::wait() const {
    char answer = 0;
    return read(from_child_, &answer, 1) == 1;
}

void Embree::set(const Geometry& geometry) {
    EmbreeTalk& talk = *talk_;
    float* vertex = talk.vertices;
    const auto put = [&vertex](double x) { *vertex++ = static_cast<float>(x); };
    std::uint32_t count = 0;
    talk.index_count = 0;
    if (geometry.radius > 0) {
        for (const double x : {geometry.center.x, geometry.center.y, geometry.center.z, geometry.radius}) put(x);
        talk.corners = 1, count = 1;
    } else if (!geometry.quads.empty()) {
        for (const Parallelogram& q : geometry.quads) {
            for (const Point3& p :
                 {q.corner, q.corner + q.edge_u, q.corner + q.edge_u + q.edge_v, q.corner + q.edge_v}) {
                put(p.x), put(p.y), put(p.z);
                talk.indices[talk.index_count++] = count++;
            }
        }
        talk.corners = 4;
    } else {
        for (const Float3& p : geometry.mesh.vertices) put(p.x), put(p.y), put(p.z), ++count;
        for (const Index3& f : geometry.mesh.triangles)
            for (const std::uint32_t corner : {f.a, f.b, f.c}) talk.indices[talk.index_count++] = corner;
        talk.corners = 3;
    }
    talk.vertex_count = count;
    talk.has_transform = geometry.world_from_object.has_value();
    if (geometry.world_from_object)
        for (std::size_t i = 0; i < 12; ++i)
            talk.transform[i] = static_cast<float>(geometry.world_from_object->rows[i % 3][i / 3]);
    order(kBuildScene);
    check(wait(), "building Embree's scene");
}

void Embree::start(std::span<const Ray> rays) {
    talk_->ray_count = static_cast<std::uint32_t>(rays.size());
    talk_->progress = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Ray& r = rays[i];
        const auto f = [](double x) { return static_cast<float>(x); };
        talk_->rays[i] = {{f(r.origin.x), f(r.origin.y), f(r.origin.z)},
                          {f(r.direction.x), f(r.direction.y), f(r.direction.z)},
                          f(r.t_min),
                          f(r.t_max)};
    }
    order(kTrace);
}

void Embree::finish(std::vector<Answer>& plain, std::vector<Answer>& robust) {
    EmbreeTalk& talk = *talk_;
    std::vector<Answer>* const out[kModes] = {&plain, &robust};
    for (auto* answers : out) answers->assign(talk.ray_count, {});
    while (!wait()) {
        const std::uint32_t fatal = talk.progress;
        reap();
        spawn();
        if (fatal < talk.ray_count * kModes) (*out[fatal % kModes])[fatal / kModes].aborted = true;
        talk.progress = fatal + 1;
        order(kBuildScene);
        check(wait(), "building Embree's scene again");
        order(kTrace);
    }
    for (std::uint32_t mode = 0; mode < kModes; ++mode) {
        for (std::uint32_t i = 0; i < talk.ray_count; ++i) {
            const EmbreeAnswer& from = talk.answers[mode][i];
            Answer& to = (*out[mode])[i];
            if (to.aborted) continue;
            to = {static_cast<double>(from.t), static_cast<double>(from.u), static_cast<double>(from.v),
                  from.primitive};
        }
    }
}

}  // namespace limn::accuracy
