// SPDX-License-Identifier: LGPL-2.1-or-later
// Progress and cancellation: a callback that long stages poll cheaply.
#pragma once

#include <chrono>
#include <exception>
#include <functional>
#include <string>

namespace tetra {

// Thrown from Progress::poll when the caller asked to stop.
struct Cancelled : std::exception {
    const char* what() const noexcept override { return "cancelled"; }
};

// The callback gets (stage, fraction in 0..1) and returns false to cancel. It is called at most
// every 20 ms, so poll() may stand in inner loops.
class Progress {
  public:
    using Callback = std::function<bool(const std::string& stage, double fraction)>;

    Progress() = default;
    explicit Progress(Callback callback) : callback_(std::move(callback)) {}

    void poll(const char* stage, double fraction) {
        if (!callback_) return;
        const auto now = std::chrono::steady_clock::now();
        if (now - last_ < std::chrono::milliseconds(20)) return;
        last_ = now;
        if (!callback_(stage, fraction)) throw Cancelled();
    }

  private:
    Callback callback_;
    std::chrono::steady_clock::time_point last_{};
};

}  // namespace tetra
