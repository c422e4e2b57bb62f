// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "emulator/core/delay/law.hpp"
#include "emulator/core/loss/law.hpp"

#include <string_view>
#include <tuple>

namespace hapnet::emulator {

/// Whether a parameter has to be written. What need not be is printed only when it differs from
/// the default.
enum class Need { required, optional };

/// What a whole number of 64 bits counts.
enum class Counts { bytes, bits_per_second };

/// A parameter of T: its key in a profile, and where it is kept.
template <typename T, typename Value>
struct Field {
    std::string_view key;
    Value T::*member;
    Need need = Need::required;
    Counts counts = Counts::bytes;
};

// Clang 14 does not deduce the arguments of an aggregate by itself.
template <typename T, typename Value>
Field(std::string_view, Value T::*, Need = {}, Counts = {}) -> Field<T, Value>;

/// How T is written in a profile: the name of the law, and its parameters. Reading, printing and
/// ramps all go by it, so that none of them can forget a parameter.
template <typename T>
struct Form;

namespace detail {

template <typename T>
struct Defaults {
    static T defaults() { return {}; }
};

/// In the chains of Gilbert and Elliott, bad means lost unless a profile says otherwise.
template <typename T>
struct LossyWhenBad {
    static T defaults()
    {
        T law;
        law.loss_bad = base::Probability::from_fraction(1.0).value();
        return law;
    }
};

} // namespace detail

template <>
struct Form<ConstantLaw> : detail::Defaults<ConstantLaw> {
    static constexpr std::string_view name = "constant";
    static constexpr std::tuple fields{Field{"value", &ConstantLaw::value}};
};

template <>
struct Form<UniformLaw> : detail::Defaults<UniformLaw> {
    static constexpr std::string_view name = "uniform";
    static constexpr std::tuple fields{Field{"mean", &UniformLaw::mean, Need::optional},
                                       Field{"half_width", &UniformLaw::half_width}};
};

template <>
struct Form<NormalLaw> : detail::Defaults<NormalLaw> {
    static constexpr std::string_view name = "normal";
    static constexpr std::tuple fields{Field{"mean", &NormalLaw::mean, Need::optional},
                                       Field{"sd", &NormalLaw::sd}};
};

template <>
struct Form<LogNormalLaw> : detail::Defaults<LogNormalLaw> {
    static constexpr std::string_view name = "log-normal";
    static constexpr std::tuple fields{Field{"mean", &LogNormalLaw::mean},
                                       Field{"sd", &LogNormalLaw::sd}};
};

template <>
struct Form<ExponentialLaw> : detail::Defaults<ExponentialLaw> {
    static constexpr std::string_view name = "exponential";
    static constexpr std::tuple fields{Field{"mean", &ExponentialLaw::mean}};
};

template <>
struct Form<ParetoLaw> : detail::Defaults<ParetoLaw> {
    static constexpr std::string_view name = "pareto";
    static constexpr std::tuple fields{Field{"mean", &ParetoLaw::mean},
                                       Field{"shape", &ParetoLaw::shape, Need::optional}};
};

template <>
struct Form<GammaLaw> : detail::Defaults<GammaLaw> {
    static constexpr std::string_view name = "gamma";
    static constexpr std::tuple fields{Field{"mean", &GammaLaw::mean}, Field{"sd", &GammaLaw::sd}};
};

template <>
struct Form<TableLaw> : detail::Defaults<TableLaw> {
    static constexpr std::string_view name = "table";
    static constexpr std::tuple fields{Field{"file", &TableLaw::file},
                                       Field{"mean", &TableLaw::mean, Need::optional},
                                       Field{"sd", &TableLaw::sd, Need::optional}};
};

template <>
struct Form<TraceLaw> : detail::Defaults<TraceLaw> {
    static constexpr std::string_view name = "trace";
    static constexpr std::tuple fields{Field{"file", &TraceLaw::file}};
};

template <>
struct Form<RandomLoss> : detail::Defaults<RandomLoss> {
    static constexpr std::string_view name = "random";
    static constexpr std::tuple fields{Field{"share", &RandomLoss::share}};
};

template <>
struct Form<BlockLoss> : detail::Defaults<BlockLoss> {
    static constexpr std::string_view name = "k-of-n";
    static constexpr std::tuple fields{Field{"lost", &BlockLoss::lost},
                                       Field{"of", &BlockLoss::of}};
};

template <>
struct Form<PeriodicLoss> : detail::Defaults<PeriodicLoss> {
    static constexpr std::string_view name = "every";
    static constexpr std::tuple fields{Field{"every", &PeriodicLoss::every},
                                       Field{"phase", &PeriodicLoss::phase, Need::optional}};
};

template <>
struct Form<Burst> : detail::Defaults<Burst> {
    static constexpr std::string_view name = "burst";
    static constexpr std::tuple fields{Field{"lost", &Burst::lost}, Field{"of", &Burst::of},
                                       Field{"phase", &Burst::phase, Need::optional}};
};

template <>
struct Form<TimedBurst> : detail::Defaults<TimedBurst> {
    static constexpr std::string_view name = "timed-burst";
    static constexpr std::tuple fields{Field{"lost", &TimedBurst::lost},
                                       Field{"every", &TimedBurst::every},
                                       Field{"phase", &TimedBurst::phase, Need::optional}};
};

template <>
struct Form<Gilbert> : detail::Defaults<Gilbert> {
    static constexpr std::string_view name = "gilbert";
    static constexpr std::tuple fields{Field{"share", &Gilbert::share},
                                       Field{"mean_burst", &Gilbert::mean_burst}};
};

template <>
struct Form<GilbertElliott> : detail::LossyWhenBad<GilbertElliott> {
    static constexpr std::string_view name = "gilbert-elliott";
    static constexpr std::tuple fields{
        Field{"good_to_bad", &GilbertElliott::good_to_bad},
        Field{"bad_to_good", &GilbertElliott::bad_to_good},
        Field{"loss_good", &GilbertElliott::loss_good, Need::optional},
        Field{"loss_bad", &GilbertElliott::loss_bad, Need::optional}};
};

template <>
struct Form<TimedGilbertElliott> : detail::LossyWhenBad<TimedGilbertElliott> {
    static constexpr std::string_view name = "timed-gilbert-elliott";
    static constexpr std::tuple fields{
        Field{"mean_good", &TimedGilbertElliott::mean_good},
        Field{"mean_bad", &TimedGilbertElliott::mean_bad},
        Field{"loss_good", &TimedGilbertElliott::loss_good, Need::optional},
        Field{"loss_bad", &TimedGilbertElliott::loss_bad, Need::optional}};
};

template <>
struct Form<FourState> : detail::Defaults<FourState> {
    static constexpr std::string_view name = "four-state";
    static constexpr std::tuple fields{
        Field{"share", &FourState::share}, Field{"burst", &FourState::burst},
        Field{"density", &FourState::density}, Field{"isolated", &FourState::isolated},
        Field{"good_run", &FourState::good_run, Need::optional}};
};

template <>
struct Form<ListedLoss> : detail::Defaults<ListedLoss> {
    static constexpr std::string_view name = "list";
    static constexpr std::tuple fields{Field{"numbers", &ListedLoss::numbers}};
};

template <>
struct Form<PatternLoss> : detail::Defaults<PatternLoss> {
    static constexpr std::string_view name = "pattern";
    static constexpr std::tuple fields{Field{"pattern", &PatternLoss::pattern}};
};

template <>
struct Form<TraceLoss> : detail::Defaults<TraceLoss> {
    static constexpr std::string_view name = "trace";
    static constexpr std::tuple fields{Field{"file", &TraceLoss::file}};
};

template <>
struct Form<Outage> : detail::Defaults<Outage> {
    static constexpr std::string_view name = "outage";
    static constexpr std::tuple fields{Field{"windows", &Outage::windows}};
};

// Stages that are no laws: the first parameter is the short form.

template <>
struct Form<Rate> : detail::Defaults<Rate> {
    static constexpr std::tuple fields{
        Field{"limit", &Rate::bits_per_second, Need::required, Counts::bits_per_second},
        Field{"overhead", &Rate::overhead_bytes, Need::optional},
        Field{"queue", &Rate::queue_bytes_max, Need::optional}};
};

template <>
struct Form<Corruption> : detail::Defaults<Corruption> {
    static constexpr std::tuple fields{Field{"share", &Corruption::share},
                                       Field{"bits", &Corruption::bits, Need::optional}};
};

template <>
struct Form<Duplication> : detail::Defaults<Duplication> {
    static constexpr std::tuple fields{Field{"share", &Duplication::share},
                                       Field{"spread", &Duplication::spread, Need::optional}};
};

template <>
struct Form<Reordering> : detail::Defaults<Reordering> {
    static constexpr std::tuple fields{Field{"share", &Reordering::share},
                                       Field{"displacement", &Reordering::displacement}};
};

template <>
struct Form<Mtu> : detail::Defaults<Mtu> {
    static constexpr std::tuple fields{Field{"limit", &Mtu::bytes_max}};
};

} // namespace hapnet::emulator
