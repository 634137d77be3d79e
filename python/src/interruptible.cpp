#include "interruptible.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

namespace limn::python {

namespace nb = nanobind;

namespace {

constexpr std::chrono::milliseconds kPatience{50};

// What the render and the waiting thread tell each other.
struct Shared {
    std::mutex mutex;
    std::condition_variable changed;
    Progress progress;
    bool moved = false, done = false, stop = false;
    RenderResult result;
    std::exception_ptr failure;

    bool note(const Progress& now) {
        const std::lock_guard lock(mutex);
        progress = now;
        moved = true;
        changed.notify_one();
        return !stop;
    }
    void end() {
        const std::lock_guard lock(mutex);
        stop = true;
    }
};

void run(const CompiledScene& scene, const Camera& camera, const RenderSettings& settings, Shared& shared) {
    RenderResult result;
    std::exception_ptr failure;
    try {
        result = render(scene, camera, settings);
    } catch (...) {
        failure = std::current_exception();
    }
    const std::lock_guard lock(shared.mutex);
    shared.result = std::move(result);
    shared.failure = failure;
    shared.done = true;
    shared.changed.notify_one();
}

// Ends the render and waits for it, however the caller is left. The lock is let go: the render may need it to end.
class Worker {
public:
    Worker(Shared& shared, std::thread thread) : shared_(shared), thread_(std::move(thread)) {}
    ~Worker() {
        shared_.end();
        const nb::gil_scoped_release release;
        thread_.join();
    }
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

private:
    Shared& shared_;
    std::thread thread_;
};

}  // namespace

RenderResult render_interruptibly(const CompiledScene& scene, const Camera& camera, RenderSettings settings,
                                  nb::handle progress) {
    Shared shared;
    settings.progress = [&](const Progress& now) { return shared.note(now); };
    {
        const Worker worker(shared, std::thread([&] { run(scene, camera, settings, shared); }));
        for (bool done = false; !done;) {
            Progress now;
            bool moved = false;
            {
                const nb::gil_scoped_release release;
                std::unique_lock lock(shared.mutex);
                shared.changed.wait_for(lock, kPatience, [&] { return shared.done || shared.moved; });
                done = shared.done;
                moved = std::exchange(shared.moved, false);
                now = shared.progress;
            }
            if (PyErr_CheckSignals() != 0) throw nb::python_error();
            if (!moved || progress.is_none()) continue;
            if (progress(now).ptr() == Py_False) shared.end();
        }
    }
    if (shared.failure) std::rethrow_exception(shared.failure);
    return std::move(shared.result);
}

}  // namespace limn::python
