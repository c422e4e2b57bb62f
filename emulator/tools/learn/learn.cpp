// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/learn/learn.hpp"

#include "emulator/core/profile/text.hpp"
#include "emulator/tools/learn/delays.hpp"
#include "emulator/tools/learn/losses.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator::tools {

namespace {

constexpr double alpha = 1e-3;

double milliseconds_of(base::Duration duration)
{
    return std::chrono::duration<double, std::milli>{duration}.count();
}

/// Writes what it finds about one way into conditions and remarks.
class WayLearner {
public:
    WayLearner(std::string name, Conditions& way, std::vector<std::string>& remarks)
        : name_{std::move(name)}, way_{way}, remarks_{remarks}
    {}

    void learn_delays(const MeasuredWay& measured, std::optional<base::Duration> spacing)
    {
        const DelayFit fit = fit_delays(measured, spacing);
        const DelayModel& nearest = fit.models.front();
        way_.delay = constant(nearest.base);
        if (nearest.name == "constant") {
            return say(fmt::format("delay: always {:.3f} ms", milliseconds_of(nearest.base)));
        }
        way_.jitter = {nearest.jitter, fit.correlation_time};
        for (const DelayModel& model : fit.models) say(in_words(model));
        if (!nearest.p_value) {
            say(fmt::format("delay: {} independent delays are too few to test a law",
                            fit.independent));
        } else if (*nearest.p_value < alpha) {
            say(fmt::format("delay: no law passes; {} is the nearest. The measured values "
                            "themselves are jitter = {{ law = \"table\", file = ... }}",
                            nearest.name));
        }
        if (fit.correlation_time > base::Duration{0}) {
            const auto n = static_cast<double>(measured.delays.size());
            const double rho = fit.correlation;
            say(fmt::format("delay: neighbours have the correlation {:.3f} +- {:.3f}, which makes "
                            "correlation_time {:.3g} ms",
                            rho, std::sqrt((1.0 - rho * rho) / n),
                            milliseconds_of(fit.correlation_time)));
        } else if (!spacing && fit.correlation > 0.1) {
            say(fmt::format("delay: neighbours have the correlation {:.3f}; the time between "
                            "datagrams is not known, so correlation_time is not either",
                            fit.correlation));
        }
    }

    void learn_losses(const MeasuredWay& measured)
    {
        const auto models = fit_losses(measured.lost);
        const auto lost = std::count(measured.lost.begin(), measured.lost.end(), true);
        const auto n = static_cast<double>(measured.lost.size());
        if (models.empty()) {
            // The rule of three: 95 % of the time.
            return say(fmt::format("loss: none of {}, so at most {:.2g} %", measured.lost.size(),
                                   300.0 / n));
        }
        for (const LossModel& model : models) {
            say(fmt::format("loss {}: BIC {:+.1f}, parameters: {}", model.name,
                            model.bic - models.front().bic, model.parameters));
        }
        const double share = static_cast<double>(lost) / n;
        say(fmt::format("loss: {} of {} lost, {:.4g} +- {:.2g} % if they are independent", lost,
                        measured.lost.size(), 100.0 * share,
                        100.0 * std::sqrt(share * (1.0 - share) / n)));
        way_.loss = {models.front().law};
    }

    void learn_order(const MeasuredWay& measured)
    {
        if (measured.reordered == 0) return;
        way_.order = Order::free;
        say(fmt::format("order: {:.3g} % arrived after one that was sent later: order = \"free\"",
                        100.0 * static_cast<double>(measured.reordered) /
                            static_cast<double>(measured.lost.size())));
    }

private:
    [[nodiscard]] static std::string in_words(const DelayModel& model)
    {
        auto text = fmt::format("delay {}: {:.4f} apart", model.name, model.distance);
        if (!model.p_value) return text;
        return text + fmt::format(", p = {:.3g} (Kolmogorov-Smirnov, with fitted parameters): {}",
                                  *model.p_value, *model.p_value < alpha ? "rejected" : "passes");
    }

    void say(const std::string& remark) { remarks_.push_back(name_ + ": " + remark); }

    std::string name_;
    Conditions& way_;
    std::vector<std::string>& remarks_;
};

bool is_all_lost(const MeasuredWay& way)
{
    return std::find(way.lost.begin(), way.lost.end(), false) == way.lost.end();
}

} // namespace

base::Result<Lesson> learn(const Measurement& measurement)
{
    const auto& [measured_up, measured_down, spacing] = measurement;
    if (is_all_lost(measured_down) || (measured_up && is_all_lost(*measured_up))) {
        return base::fail("nothing arrived: there is no delay to learn");
    }
    Lesson lesson;
    lesson.profile.name = "learned";
    auto& [up, down] = lesson.profile.path;
    if (spacing) {
        lesson.remarks.push_back(fmt::format("{} datagrams, one every {:.4g} ms",
                                             measured_down.lost.size(), milliseconds_of(*spacing)));
    }
    WayLearner learner{measured_up ? "down" : "round trip", down, lesson.remarks};
    learner.learn_delays(measured_down, spacing);
    learner.learn_losses(measured_down);
    learner.learn_order(measured_down);
    if (measured_up) {
        WayLearner{"up", up, lesson.remarks}.learn_delays(*measured_up, spacing);
        lesson.remarks.emplace_back("The file does not say on which way a datagram was lost: all "
                                    "losses are put into the way down");
        return lesson;
    }
    const auto whole = std::get<ConstantLaw>(down.delay.law).value;
    up.delay = constant(whole / 2);
    down.delay = constant(whole - whole / 2);
    lesson.remarks.emplace_back(
        "A round trip does not tell its two ways apart: each has half of the least delay, and all "
        "jitter, loss and order are down");
    return lesson;
}

std::string to_text(const Lesson& lesson)
{
    std::string text;
    for (const std::string& remark : lesson.remarks) text += "# " + remark + "\n";
    return text + to_text(lesson.profile);
}

} // namespace hapnet::emulator::tools
