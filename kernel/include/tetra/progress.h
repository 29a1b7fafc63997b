// SPDX-License-Identifier: LGPL-2.1-or-later
// Progress and cancellation: a callback that long stages poll cheaply.
#pragma once

#include <algorithm>
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
        if (!callback_ || (stage == stage_ && --unread_ > 0)) return;
        const auto now = std::chrono::steady_clock::now();
        read_clock(stage, now);
        if (now - last_ < std::chrono::milliseconds(20)) return;
        last_ = now;
        if (!callback_(stage, fraction)) throw Cancelled();
    }

  private:
    using Time = std::chrono::steady_clock::time_point;

    // Calls that follow each other closely don't look at the clock each time: doubling stops
    // where a look would come later than a millisecond after the one before.
    void read_clock(const char* stage, Time now) {
        const bool dense = stage == stage_ && now - read_ < std::chrono::milliseconds(1);
        stride_ = dense ? std::min(2 * stride_, 16) : 1;
        unread_ = stride_;
        stage_ = stage;
        read_ = now;
    }

    Callback callback_;
    Time last_{}, read_{};
    const char* stage_ = nullptr;
    int stride_ = 1, unread_ = 0;
};

}  // namespace tetra
