// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/conformance/subject.hpp"
#include "device/page/page_hand.hpp"

#include <chrono>

namespace hapnet::conformance {

namespace {

/// A page that sends a place for its hand in every tick.
class PageSubject final : public Subject {
public:
    [[nodiscard]] Traits traits() const override { return only_software; }
    [[nodiscard]] device::Opened<std::unique_ptr<device::Device>> open() override
    {
        wishes_ = std::make_shared<device::HandWishes>();
        auto page = std::make_unique<device::PageHand>(wishes_);
        page->on_cue({.start = now_, .hands_on = std::chrono::seconds{30}, .seed = base::Seed{1}});
        wishes_->put(device::HandWish{});
        return page;
    }
    [[nodiscard]] base::TimePoint now() override { return now_; }
    void pass(base::Duration duration) override
    {
        now_ += duration;
        if (wishes_) wishes_->put(device::HandWish{});
    }
    [[nodiscard]] std::vector<Command> commands() const override { return {}; }

private:
    base::TimePoint now_{std::chrono::seconds{1000}};
    std::shared_ptr<device::HandWishes> wishes_;
};

} // namespace

std::unique_ptr<Subject> make_subject() { return std::make_unique<PageSubject>(); }

} // namespace hapnet::conformance
