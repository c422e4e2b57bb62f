// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/control/turns.hpp"

namespace hapnet::control {

void Turns::run(const Step& step)
{
    is_done_ = false;
    work_.store(&step);
    ordered_.signal();
    // Either the loop sees the work when it closes, or this thread sees that the loop has closed.
    if (is_closed_.load()) work_.store(nullptr);
    work_.wait(&step);
    if (!is_done_) throw LoopHasEnded{};
}

std::optional<base::TimePoint> Turns::next_deadline() const
{
    if (work_.load() == nullptr) return std::nullopt;
    return last_step_ + pause;
}

bool Turns::is_due(base::TimePoint now, std::optional<base::TimePoint> next_departure) const
{
    if (work_.load() == nullptr) return false;
    const bool is_in_the_way = base::is_due(next_departure, now + step_takes);
    return now - last_step_ >= (is_in_the_way ? put_off_max : pause);
}

void Turns::take(base::TimePoint now)
{
    ordered_.clear();
    last_step_ = now;
    const Step* work = work_.load();
    if (work == nullptr || !(*work)()) return;
    is_done_ = true;
    work_.store(nullptr);
    work_.notify_one();
}

void Turns::close()
{
    is_closed_.store(true);
    if (work_.exchange(nullptr) != nullptr) work_.notify_one();
}

} // namespace hapnet::control
