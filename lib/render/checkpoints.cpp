#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include "limn/core/error.h"
#include "limn/render/render_job.h"

namespace limn {

class Checkpoints::Impl {
public:
    Impl(const RenderJob& job, const std::string& path, double seconds, std::function<void(const Error&)> failed)
        : thread_([this, &job, path, seconds, failed = std::move(failed)] {
              const std::chrono::duration<double> pause(std::min(seconds, 1e9));
              std::unique_lock lock(mutex_);
              while (!end_wanted_.wait_for(lock, pause, [this] { return ended_; })) try {
                      job.save(path);
                  } catch (const Error& e) {
                      failed(e);
                  }
          }) {}
    ~Impl() {
        {
            const std::scoped_lock lock(mutex_);
            ended_ = true;
        }
        end_wanted_.notify_one();
        thread_.join();
    }

private:
    std::mutex mutex_;
    std::condition_variable end_wanted_;
    bool ended_ = false;
    std::thread thread_;  // last: it uses the others
};

Checkpoints::Checkpoints(const RenderJob& job, const std::string& path, double seconds,
                         std::function<void(const Error&)> failed) {
    if (!(seconds > 0)) throw ArgumentError("Checkpoints: the seconds between two must be over 0");
    impl_ = std::make_unique<Impl>(job, path, seconds, std::move(failed));
}
Checkpoints::~Checkpoints() = default;

}  // namespace limn
