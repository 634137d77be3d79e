#include "interruptible.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

namespace limn::python {

namespace nb = nanobind;

namespace {

// The longest time between two checks for signals.
constexpr std::chrono::milliseconds kPatience{50};

// The state that the rendering thread and the waiting thread share. `mutex` guards all members.
struct Shared {
    std::mutex mutex;
    std::condition_variable changed;  // signals that `moved` or `done` was set
    Progress progress;
    bool moved = false;  // true if the waiting thread hasn't seen `progress` yet
    bool done = false;   // true if the render has ended and `result` and `failure` are set
    bool stop = false;   // true if the render shall end
    RenderResult result;
    std::exception_ptr failure;  // the exception of the render, or null

    // Is the progress callback of the render. Returns false to end the render.
    bool note(const Progress& now) {
        const std::lock_guard lock(mutex);
        progress = now;
        moved = true;
        changed.notify_one();
        return !stop;
    }
    // Ends the render at its next progress callback.
    void end() {
        const std::lock_guard lock(mutex);
        stop = true;
    }
};

// Renders in the calling thread and stores the result or the exception in `shared`.
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

// The rendering thread. The destructor ends the render and waits for the thread, also if an exception is thrown. It
// releases the GIL, which the render may need before it can end.
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
                // Wait for progress or the end, without the GIL.
                const nb::gil_scoped_release release;
                std::unique_lock lock(shared.mutex);
                shared.changed.wait_for(lock, kPatience, [&] { return shared.done || shared.moved; });
                done = shared.done;
                moved = std::exchange(shared.moved, false);
                now = shared.progress;
            }
            // Handle signals, then call the callback.
            if (PyErr_CheckSignals() != 0) throw nb::python_error();
            if (!moved || progress.is_none()) continue;
            if (progress(now).ptr() == Py_False) shared.end();
        }
    }
    if (shared.failure) std::rethrow_exception(shared.failure);
    return std::move(shared.result);
}

}  // namespace limn::python
