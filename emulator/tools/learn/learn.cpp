// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/learn/learn.hpp"

#include "emulator/core/profile/text.hpp"
#include "emulator/tools/learn/delays.hpp"
#include "emulator/tools/learn/losses.hpp"
#include "emulator/tools/learn/regimes_fit.hpp"
#include "emulator/tools/learn/text_plot.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>
#include <array>
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

/// Returns the number of datagrams that arrived after one that was sent later, if times and delays
/// are known.
std::size_t overtaken(const MeasuredWay& way)
{
    if (!way.spacing) return 0;
    base::Duration last = base::Duration::min();
    std::size_t count = 0;
    for (std::size_t i = 0; i < way.delays.size(); ++i) {
        if (!way.delays[i]) continue;
        const auto at = *way.spacing * static_cast<base::Duration::rep>(i) + *way.delays[i];
        if (at < last) ++count;
        last = std::max(last, at);
    }
    return count;
}

/// Writes the results about one direction into conditions and remarks.
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
            say(fmt::format("delay: no law passes; {} is the nearest", nearest.name));
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

    /// Learns delays and losses in `count` regimes, and returns their figures. The error: the
    /// regimes are too short, too few stays were measured, or the regimes are not valid.
    base::Result<std::vector<LearnedRegime>> learn_regimes(const MeasuredWay& measured,
                                                           std::size_t count, bool with_losses)
    {
        const auto fit = fit_regimes(measured, count);
        if (!fit) return base::fail("the regimes are too short, or too few stays were measured");
        std::vector<Regime> all;
        for (std::size_t i = 0; i < count; ++i) {
            const RegimeFit& one = fit->regimes[i];
            all.push_back(regime_of(one, own_rows(measured, one), with_losses));
            all.back().name = regime_name(i, count);
            all.back().stay = rounded(one.stay_rows * base::to_nanoseconds(*measured.spacing));
        }
        for (std::size_t i = 0; i < count && count > 2; ++i) {
            for (std::size_t k = 0; k < count; ++k) {
                const double weight = std::round(1e3 * fit->regimes[i].followers[k]) / 1e3;
                if (weight > 0.0) all[i].to.emplace_back(all[k].name, weight);
            }
        }
        Regimes regimes{std::move(all)};
        if (auto valid = validate(regimes); !valid) return tl::unexpected{valid.error()};
        say(fmt::format("regimes: {}, by the least BIC", count));
        std::vector<LearnedRegime> found;
        for (std::size_t i = 0; i < count; ++i) {
            const RegimeFit& one = fit->regimes[i];
            found.push_back(
                learned_regime(regimes.all[i], one, own_rows(measured, one), with_losses));
            say(tools::in_words(found.back()));
        }
        way_.regimes = std::move(regimes);
        return found;
    }

    void learn_losses(const MeasuredWay& measured)
    {
        const auto models = fit_losses(measured.lost);
        const auto lost = std::count(measured.lost.begin(), measured.lost.end(), true);
        const auto n = static_cast<double>(measured.lost.size());
        if (models.empty()) {
            // The rule of three: true 95 % of the time.
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
        const auto reordered = measured.reordered > 0 ? measured.reordered : overtaken(measured);
        if (reordered == 0) return;
        way_.order = Order::free;
        say(fmt::format("order: {:.3g} % arrived after one that was sent later: order = \"free\"",
                        100.0 * static_cast<double>(reordered) /
                            static_cast<double>(measured.lost.size())));
    }

    /// Uses the measured values themselves instead of a law. `conditions` have read them from
    /// `file`.
    void take(const Conditions& conditions, const std::string& file, LearnedForm form)
    {
        way_.delay = conditions.delay;
        way_.jitter = conditions.jitter;
        if (form == LearnedForm::trace) {
            if (!conditions.loss.empty()) way_.loss = conditions.loss;
            return say(fmt::format("delay: {} is replayed", file));
        }
        say(fmt::format("delay: drawn from the values in {}", file));
    }

private:
    [[nodiscard]] static std::string regime_name(std::size_t index, std::size_t count)
    {
        constexpr std::array<const char*, 3> better{"good", "fair", "poor"};
        return index + 1 == count ? "bad" : better[index];
    }

    /// Returns the delays of a regime, each at its position in the series.
    [[nodiscard]] static MeasuredWay own_rows(const MeasuredWay& measured, const RegimeFit& fit)
    {
        MeasuredWay own{.spacing = measured.spacing};
        for (std::size_t i = 0; i < measured.delays.size(); ++i) {
            const bool is_here = fit.is_own[i] != 0;
            own.add(is_here ? measured.delays[i] : std::nullopt, measured.lost[i] || !is_here);
        }
        return own;
    }

    /// Returns a regime without its name and its stay.
    [[nodiscard]] static Regime regime_of(const RegimeFit& fit, const MeasuredWay& own,
                                          bool with_losses)
    {
        Regime regime;
        const DelayFit delays = fit_delays(own);
        const DelayModel& nearest = delays.models.front();
        regime.own.delay = constant(nearest.base);
        if (nearest.name != "constant") {
            regime.own.jitter = Variation{nearest.jitter, delays.correlation_time};
        }
        if (with_losses) {
            const double share = std::round(1e7 * fit.lost / fit.rows) / 1e7;
            if (share > 0.0) {
                regime.own.loss = {
                    RandomLoss{base::Probability::from_fraction(std::min(share, 1.0)).value()}};
            }
        }
        return regime;
    }

    [[nodiscard]] static base::Duration rounded(double nanoseconds)
    {
        return std::chrono::microseconds{std::llround(nanoseconds / 1e3)};
    }

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

    /// Names the chosen model, and the arguments against it.
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

/// True if the direction exists and has no delay.
bool has_no_delay(const std::optional<MeasuredWay>& way)
{
    return way &&
           std::ranges::none_of(way->delays, [](const auto& one) { return one.has_value(); });
}

/// The conditions of a direction, and the figures of their regimes.
struct LearnedWay {
    Conditions conditions;
    std::vector<LearnedRegime> regimes{};
};

struct Choice {
    LearnedForm form = LearnedForm::laws;
    std::size_t regimes = 1; // number of regimes in the form LearnedForm::regimes
};

/// One direction of a measurement. It chooses the form by the first half, and learns the whole in
/// this form.
class WayCourse {
public:
    /// `with_losses`: the losses are those of this direction.
    WayCourse(std::string name, const MeasuredWay& measured, bool with_losses,
              const LearnSettings& settings)
        : name_{std::move(name)}, measured_{measured}, with_losses_{with_losses}
    {
        const auto table = settings.tables.find(name_);
        if (table != settings.tables.end()) table_ = table->second;
        replays_ = settings.replays && table_;
    }

    [[nodiscard]] base::Result<Conditions> learn(Lesson& lesson) const
    {
        WayLesson way{.way = name_};
        Lesson unsaid;
        const auto [first, second] = halves_of(measured_);
        const bool can_judge =
            first.delays.size() >= half_rows_min && has_delay(first) && has_delay(second);
        bool is_fine = true;
        Choice choice;
        if (replays_) {
            choice.form = LearnedForm::trace;
        } else if (can_judge) {
            const auto chosen = form_of(first);
            is_fine = chosen.has_value();
            if (chosen) choice = *chosen;
        }
        auto all = in_form(choice, measured_, table_, lesson);
        if (!all && choice.form == LearnedForm::regimes) {
            choice = {table_ ? LearnedForm::trace : LearnedForm::laws};
            is_fine = false;
            all = in_form(choice, measured_, table_, lesson);
        }
        if (!all) return tl::unexpected{all.error()};
        way.form = choice.form;
        way.regimes = std::move(all->regimes);
        if (can_judge) {
            auto half = in_form(choice, first, named_table(first_half, first), unsaid);
            if (!half) return tl::unexpected{half.error()};
            way.likeness = likeness_of(half->conditions, first, second);
            say(lesson, way, is_fine);
        }
        lesson.ways.push_back(std::move(way));
        return std::move(all->conditions);
    }

private:
    static constexpr std::size_t half_rows_min = 200;
    static constexpr const char* first_half = "the first half";

    [[nodiscard]] static bool has_delay(const MeasuredWay& way)
    {
        return std::ranges::any_of(way.delays, [](const auto& one) { return one.has_value(); });
    }

    /// Returns the simplest form that reproduces the delays of the half that it was learned from;
    /// nullopt: laws do not reproduce them, and no other form is possible.
    [[nodiscard]] std::optional<Choice> form_of(const MeasuredWay& half) const
    {
        Lesson unsaid;
        for (const LearnedForm form :
             {LearnedForm::laws, LearnedForm::regimes, LearnedForm::table}) {
            Choice choice{form};
            if (form == LearnedForm::regimes) {
                choice.regimes = count_regimes(half);
                if (choice.regimes < 2) continue;
            }
            const auto learned = in_form(choice, half, named_table(first_half, half), unsaid);
            if (learned && is_near(learned->conditions, half)) {
                const bool can_be_named = form != LearnedForm::table || table_;
                return can_be_named ? std::optional{choice} : std::nullopt;
            }
        }
        return table_ ? std::optional{Choice{LearnedForm::trace}} : std::nullopt;
    }

    [[nodiscard]] base::Result<LearnedWay> in_form(const Choice& choice,
                                                   const MeasuredWay& measured,
                                                   const std::optional<MeasuredTable>& table,
                                                   Lesson& lesson) const
    {
        Conditions way;
        const LearnedForm form = choice.form;
        WayLearner learner{name_, way, lesson};
        if (form == LearnedForm::regimes) {
            auto learned = learner.learn_regimes(measured, choice.regimes, with_losses_);
            if (!learned) return tl::unexpected{learned.error()};
            learner.learn_order(measured);
            return LearnedWay{std::move(way), *std::move(learned)};
        }
        learner.learn_delays(measured);
        if (with_losses_) learner.learn_losses(measured);
        learner.learn_order(measured);
        if (form == LearnedForm::laws) return LearnedWay{std::move(way)};
        const auto least = std::get<ConstantLaw>(way.delay.law).value;
        auto read = form == LearnedForm::trace
                        ? replayed(*table)
                        : drawn_from(*table, std::max(least, base::Duration{0}),
                                     way.jitter.correlation_time);
        if (!read) return tl::unexpected{read.error()};
        learner.take(*read, table->file, form);
        return LearnedWay{std::move(way)};
    }

    void say(Lesson& lesson, const WayLesson& way, bool is_fine) const
    {
        const auto add = [&](const std::string& words) {
            lesson.remarks.push_back(name_ + ": " + words);
        };
        const Likeness& like = *way.likeness;
        if (way.form == LearnedForm::regimes) {
            add("no single law gives the delays that were measured, and their correlation and "
                "losses: the path changes between regimes");
        } else if (way.form == LearnedForm::table) {
            add("no law gives the delays that were measured (at most 0.03 apart), so they are "
                "drawn from the measured values");
        } else if (way.form == LearnedForm::trace && !replays_) {
            add("neither a law nor drawn values give the correlation that was measured, of delays "
                "or of delay and loss, so the measurement is replayed");
        } else if (!is_fine) {
            add("no law gives the delays that were measured, and no profile can name these files: "
                "--trace FILE writes the values themselves, and a profile that replays them");
        }
        add(fmt::format("the first half alone, learned so and played, is {:.3f} from the second "
                        "half (Kolmogorov-Smirnov); the measured first half is {:.3f} from it",
                        like.model_apart, like.halves_apart));
        for (const CorrelationAt& at : like.correlations) {
            add(fmt::format("correlation of delays {:.3g} s apart: {:.2f}; first half {:.2f}, "
                            "second half {:.2f}",
                            base::to_seconds(at.lag), at.model, at.first, at.second));
        }
        if (like.loss_when_slow) {
            const auto& [model, low, high] = *like.loss_when_slow;
            add(fmt::format("losses after a delay above the 90th percentile: {:.3g} %; second half "
                            "{:.3g} to {:.3g} %",
                            100.0 * model, 100.0 * low, 100.0 * high));
        }
        if (!like.is_stationary()) {
            add("the two halves differ by more than 0.1: the path itself changed, and nothing that "
                "is learned from one part is right for another");
        }
    }

    std::string name_;
    const MeasuredWay& measured_;
    bool with_losses_;
    std::optional<MeasuredTable> table_;
    bool replays_ = false;
};

} // namespace

std::string LearnReport::profile() const { return to_text(lesson->profile); }

base::Result<Lesson> learn(const Measurement& measurement, const LearnSettings& settings)
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
        auto learned = WayCourse{"round trip", *round_trip, true, settings}.learn(lesson);
        if (!learned) return tl::unexpected{learned.error()};
        down = *std::move(learned);
        const auto* least = std::get_if<ConstantLaw>(&down.delay.law);
        if (least != nullptr && down.regimes.empty()) {
            const auto whole = least->value;
            up.delay = constant(whole / 2);
            down.delay = constant(whole - whole / 2);
            lesson.remarks.emplace_back(
                "A round trip does not tell its two ways apart: each has half "
                "of the least delay, and all jitter, loss and order are down");
        } else {
            lesson.remarks.emplace_back("A round trip does not tell its two ways apart: all of it "
                                        "is down");
        }
        return lesson;
    }
    const auto learn_way = [&](const char* name, const std::optional<MeasuredWay>& measured,
                               bool with_losses, Conditions& way) -> base::Result<void> {
        if (!measured) return {};
        auto learned = WayCourse{name, *measured, with_losses, settings}.learn(lesson);
        if (!learned) return tl::unexpected{learned.error()};
        way = *std::move(learned);
        return {};
    };
    if (auto fine = learn_way("down", measured_down, true, down); !fine)
        return tl::unexpected{fine.error()};
    if (auto fine = learn_way("up", measured_up, !mixes_losses, up); !fine)
        return tl::unexpected{fine.error()};
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
