#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "limn/math/error.h"
#include "limn/render/render_job.h"

namespace limn {

class Repeated::Impl {
public:
    Impl(double seconds, std::function<void()> function)
        : thread_([this, seconds, function = std::move(function)] {
              const std::chrono::duration<double> pause(std::min(seconds, 1e9));
              std::unique_lock lock(mutex_);
              while (!end_wanted_.wait_for(lock, pause, [this] { return ended_; })) function();
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
    std::thread thread_;  // declared last, because the thread uses the members above from its start on
};

Repeated::Repeated(double seconds, std::function<void()> function) {
    if (!(seconds > 0)) throw ArgumentError("Repeated: the seconds between two calls must be over 0");
    impl_ = std::make_unique<Impl>(seconds, std::move(function));
}
Repeated::~Repeated() = default;

Checkpoints::Checkpoints(const RenderJob& job, const std::string& path, double seconds,
                         std::function<void(const Error&)> failed)
    : repeated_(seconds, [&job, path, failed = std::move(failed)] {
          try {
              job.save(path);
          } catch (const Error& e) {
              failed(e);
          } catch (const std::exception& e) {  // for example std::bad_alloc
              failed(Error(e.what()));
          }
      }) {}
Checkpoints::~Checkpoints() = default;

}  // namespace limn
