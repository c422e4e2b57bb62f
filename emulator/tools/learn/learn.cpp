// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/learn/learn.hpp"

#include "emulator/core/profile/text.hpp"
#include "emulator/tools/learn/delays.hpp"
#include "emulator/tools/learn/losses.hpp"
#include "emulator/tools/learn/text_plot.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator::tools {

namespace {

constexpr double significance = 1e-3;

double milliseconds_of(base::Duration duration)
{
    return std::chrono::duration<double, std::milli>{duration}.count();
}

/// Writes what it finds about one way into conditions and remarks.
class WayLearner {
public:
    WayLearner(std::string name, Conditions& way, Lesson& lesson)
        : name_{std::move(name)}, way_{way}, lesson_{lesson}
    {}

    void learn_delays(const MeasuredWay& measured)
    {
        const auto& spacing = measured.spacing;
        if (spacing) {
            say(fmt::format("{} datagrams, one every {:.4g} ms", measured.delays.size(),
                            milliseconds_of(*spacing)));
        }
        const DelayFit fit = fit_delays(measured);
        const DelayModel& nearest = fit.models.front();
        way_.delay = constant(nearest.base);
        if (nearest.name == "constant") {
            return say(fmt::format("delay: always {:.3f} ms", milliseconds_of(nearest.base)));
        }
        way_.jitter = {nearest.jitter, fit.correlation_time};
        lesson_.plots.push_back(fmt::format("{}: {}", name_, delay_plot(measured, nearest)));
        for (const DelayModel& model : fit.models) say(in_words(model));
        if (!nearest.p_value) {
            say(fmt::format("delay: {} independent delays are too few to test a law",
                            fit.independent));
        } else if (*nearest.p_value < significance) {
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
        const double share = static_cast<double>(lost) / n;
        say(fmt::format("loss: {} of {} lost, {:.4g} +- {:.2g} % if they are independent", lost,
                        measured.lost.size(), 100.0 * share,
                        100.0 * std::sqrt(share * (1.0 - share) / n)));
        for (const LossModel& model : models) say(in_words(model, models.front()));
        way_.loss = {models.front().law};
        lesson_.plots.push_back(fmt::format("{}: {}", name_, loss_plot(measured, models.front())));
        say(choice_in_words(models));
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
    [[nodiscard]] static std::string in_words(const LossModel& model, const LossModel& best)
    {
        auto text = fmt::format("loss {}: BIC {:+.1f}, parameters: {}", model.name,
                                model.bic - best.bic, model.parameters);
        const auto add = [&](const char* of, const std::optional<double>& p_value) {
            if (!p_value) return;
            text += fmt::format(", runs of {} p = {:.3g} ({})", of, *p_value,
                                *p_value < significance ? "rejected" : "pass");
        };
        add("losses", model.losses_p_value);
        add("arrivals", model.arrivals_p_value);
        return text;
    }

    [[nodiscard]] static bool is_rejected(const LossModel& model)
    {
        return model.losses_p_value.value_or(1.0) < significance ||
               model.arrivals_p_value.value_or(1.0) < significance;
    }

    /// Which model was taken, and what speaks against it.
    [[nodiscard]] static std::string choice_in_words(const std::vector<LossModel>& models)
    {
        const LossModel& best = models.front();
        auto text = fmt::format("loss: {} is taken", best.name);
        if (models.size() > 1) {
            const double lead = models[1].bic - best.bic;
            text += fmt::format(": its BIC is the least, {:.1f} below that of {}{}", lead,
                                models[1].name, lead < 10.0 ? ", which is no strong evidence" : "");
        }
        if (!is_rejected(best)) return text;
        return text + ". Its runs are not those that were measured: no law here describes them. "
                      "The measured losses themselves are loss = { law = \"trace\", file = ... }";
    }

    [[nodiscard]] static std::string in_words(const DelayModel& model)
    {
        auto text = fmt::format("delay {}: {:.4f} apart", model.name, model.distance);
        if (!model.p_value) return text;
        return text + fmt::format(", p = {:.3g} (Kolmogorov-Smirnov, with fitted parameters): {}",
                                  *model.p_value,
                                  *model.p_value < significance ? "rejected" : "passes");
    }

    void say(const std::string& remark) { lesson_.remarks.push_back(name_ + ": " + remark); }

    std::string name_;
    Conditions& way_;
    Lesson& lesson_;
};

/// A way without a single delay.
bool has_no_delay(const std::optional<MeasuredWay>& way)
{
    return way &&
           std::ranges::none_of(way->delays, [](const auto& one) { return one.has_value(); });
}

void learn_way(WayLearner learner, const MeasuredWay& measured, bool with_losses)
{
    learner.learn_delays(measured);
    if (with_losses) learner.learn_losses(measured);
    learner.learn_order(measured);
}

} // namespace

base::Result<Lesson> learn(const Measurement& measurement)
{
    const auto& [round_trip, measured_up, measured_down, mixes_losses, remarks] = measurement;
    base::ensure(round_trip || measured_up || measured_down);
    if (has_no_delay(round_trip) || has_no_delay(measured_up) || has_no_delay(measured_down)) {
        return base::fail("nothing arrived: there is no delay to learn");
    }
    Lesson lesson;
    lesson.remarks = remarks;
    lesson.profile.name = "learned";
    auto& [up, down] = lesson.profile.path;
    if (round_trip) {
        learn_way({"round trip", down, lesson}, *round_trip, true);
        const auto whole = std::get<ConstantLaw>(down.delay.law).value;
        up.delay = constant(whole / 2);
        down.delay = constant(whole - whole / 2);
        lesson.remarks.emplace_back("A round trip does not tell its two ways apart: each has half "
                                    "of the least delay, and all jitter, loss and order are down");
        return lesson;
    }
    if (measured_down) learn_way({"down", down, lesson}, *measured_down, true);
    if (measured_up) learn_way({"up", up, lesson}, *measured_up, !mixes_losses);
    if (mixes_losses) {
        lesson.remarks.emplace_back("The file does not say on which way a datagram was lost: all "
                                    "losses are put into the way down");
    }
    if (!measured_up || !measured_down) {
        lesson.remarks.push_back(fmt::format("Nothing was measured {}: that way has no conditions",
                                             measured_up ? "down" : "up"));
    }
    return lesson;
}

std::string to_text(const Lesson& lesson)
{
    std::string text;
    for (const std::string& remark : lesson.remarks) text += "# " + remark + "\n";
    return text + to_text(lesson.profile);
}

} // namespace hapnet::emulator::tools
