// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/netem.hpp"

#include "emulator/tools/netem_words.hpp"
#include "proto/base/reading.hpp"
#include "proto/base/text.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <spdlog/fmt/fmt.h>
#include <vector>

namespace hapnet::emulator::tools {

namespace {

using base::Probability;

constexpr base::Duration packet_spacing = std::chrono::milliseconds{1};

std::string in_ms(double nanoseconds) { return fmt::format("{:.3g} ms", nanoseconds / 1e6); }
base::Duration scaled(base::Duration duration, double by)
{
    return base::Duration{std::llround(base::to_nanoseconds(duration) * by)};
}

/// The settings of the sentence, before they are combined.
struct NetemSettings {
    base::Duration delay{};
    base::Duration jitter{};
    Probability delay_correlation{};
    std::string distribution;
    std::vector<LossLaw> loss;
    Corruption corrupt;
    Duplication duplicate;
    std::optional<Probability> reorder;
    std::uint64_t gap = 1;
    Rate rate{.bits_per_second = 0};
    std::uint64_t limit = 1000; // netem's default
    std::optional<base::Seed> seed;
    std::vector<std::string> warnings;
};

/// Warns that netem, with this correlation, draws a share that differs from this one.
void warn_of_correlated(std::string_view verb, Probability share, Probability correlation,
                        NetemSettings& said)
{
    const double real = netem_correlated_share(share.fraction(), correlation.fraction());
    said.warnings.push_back(fmt::format(
        "netem would have {} {:.3g} %, not {}: its correlated numbers gather around 1/2, and a "
        "correlation of {} changes the share",
        verb, 100.0 * real, base::to_text(share), base::to_text(correlation)));
}

void read_delay(NetemWords& words, NetemSettings& said)
{
    said.delay = words.time();
    said.jitter = words.optional_time().value_or(base::Duration{});
    said.delay_correlation = words.optional_share().value_or(Probability{});
}

void read_random_loss(NetemWords& words, NetemSettings& said)
{
    const auto share = words.share();
    const auto correlation = words.optional_share().value_or(Probability{});
    if (correlation.fraction() == 0.0 || share.fraction() == 0.0 || share.fraction() == 1.0) {
        said.loss.push_back(RandomLoss{share});
        return;
    }
    if (correlation.fraction() == 1.0) return words.complain("a correlation of 100% never ends");
    warn_of_correlated("lost", share, correlation, said);
    const double burst = 1.0 / ((1.0 - share.fraction()) * (1.0 - correlation.fraction()));
    said.warnings.push_back(fmt::format(
        "loss {} {} is done as Gilbert's model: {} lost in bursts of {:.4g} on average, in which "
        "neighbours have that correlation",
        base::to_text(share), base::to_text(correlation), base::to_text(share), burst));
    said.loss.push_back(Gilbert{share, burst});
}

void read_gemodel(NetemWords& words, NetemSettings& said)
{
    GilbertElliott law;
    law.good_to_bad = words.share();
    const auto complement = Probability::from_fraction(1.0 - law.good_to_bad.fraction());
    law.bad_to_good = words.optional_share().value_or(*complement);
    law.loss_bad = words.optional_share().value_or(*Probability::from_fraction(1.0));
    law.loss_good = words.optional_share().value_or(Probability{});
    said.loss.push_back(law);
}

/// Returns the four-state chain in its intuitive parameters (Salsano et al. 2012).
FourState in_words(double p13, double p31, double p32, double p23, double p14)
{
    const double in_gap = 1.0 / (1.0 + p13 / p31 + p13 * p32 / (p31 * p23) + p14);
    const auto probability = [](double fraction) {
        return Probability::from_fraction(std::clamp(fraction, 0.0, 1.0)).value();
    };
    return {.share = probability(in_gap * (p13 / p31 + p14)),
            .burst = (p23 + p32) / (p31 * p23),
            .density = probability(p23 / (p23 + p32)),
            .isolated = probability(p14 / (1.0 + p14)),
            .good_run = 1.0 / p23};
}

void read_states(NetemWords& words, NetemSettings& said)
{
    const auto p13 = words.share();
    const auto complement = Probability::from_fraction(1.0 - p13.fraction());
    const auto p31 = words.optional_share().value_or(*complement);
    const auto p32 = words.optional_share().value_or(Probability{});
    const auto p23 = words.optional_share().value_or(*Probability::from_fraction(1.0));
    const auto p14 = words.optional_share().value_or(Probability{});
    const auto lossy = *Probability::from_fraction(1.0);
    if (p13.fraction() == 0.0) {
        // Only single losses: the bad state is left at once.
        if (p14.fraction() > 0.0) said.loss.push_back(GilbertElliott{p14, lossy, {}, lossy});
        return;
    }
    if (p32.fraction() == 0.0 && p14.fraction() == 0.0) {
        said.loss.push_back(GilbertElliott{p13, p31, {}, lossy});
        return;
    }
    if (p31.fraction() == 0.0 || (p32.fraction() > 0.0 && p23.fraction() == 0.0)) {
        return words.complain("with p31 or p23 of 0% a burst never ends: this has no mean");
    }
    said.loss.push_back(in_words(p13.fraction(), p31.fraction(), p32.fraction(),
                                 std::max(p23.fraction(), 1e-9), p14.fraction()));
}

void read_loss(NetemWords& words, NetemSettings& said)
{
    if (words.take_if("state")) {
        read_states(words, said);
    } else if (words.take_if("gemodel")) {
        read_gemodel(words, said);
    } else {
        std::ignore = words.take_if("random");
        read_random_loss(words, said);
    }
    if (said.loss.size() > 1) return words.complain("netem has only one law of loss");
    const auto valid = said.loss.empty() ? base::Result<void>{} : validate(said.loss.front());
    if (!valid && !words.complaint()) {
        words.complain("this loss is not possible here: " + valid.error().message);
    }
}

void read_duplicate(NetemWords& words, NetemSettings& said)
{
    said.duplicate.share = words.share();
    const auto correlation = words.optional_share().value_or(Probability{});
    if (correlation.fraction() == 0.0) return;
    said.warnings.emplace_back("the correlation of duplicate has no effect: tc reads it and does "
                               "not pass it on; here it has none either");
}

void read_corrupt(NetemWords& words, NetemSettings& said)
{
    said.corrupt.share = words.share();
    const auto correlation = words.optional_share().value_or(Probability{});
    if (correlation.fraction() == 0.0) return;
    warn_of_correlated("corrupted", said.corrupt.share, correlation, said);
    said.warnings.emplace_back("the correlation of corrupt is left out: each datagram is drawn on "
                               "its own");
}

void read_reorder(NetemWords& words, NetemSettings& said)
{
    said.reorder = words.share();
    const auto correlation = words.optional_share().value_or(Probability{});
    if (correlation.fraction() == 0.0) return;
    warn_of_correlated("sent at once", *said.reorder, correlation, said);
    said.warnings.emplace_back("the correlation of reorder is left out: each datagram is drawn on "
                               "its own");
}

void read_rate(NetemWords& words, NetemSettings& said)
{
    constexpr std::int64_t headers = Mtu::header_bytes + 14; // netem counts Ethernet's too
    said.rate.bits_per_second = words.bits_per_second();
    const auto overhead = headers + words.optional_integer().value_or(0);
    if (overhead < 0 || overhead > 1000) {
        return words.complain("the overhead of a packet has to be from -42 to 958");
    }
    said.rate.overhead_bytes = static_cast<std::size_t>(overhead);
    if (words.optional_integer().value_or(0) != 0) {
        words.complain("cells are not possible here: leave CELLSIZE out");
    }
}

/// Reads one option of the sentence, by its first word.
void read_option(NetemWords& words, NetemSettings& said)
{
    struct Option {
        std::string_view name;
        void (*read)(NetemWords&, NetemSettings&);
    };
    constexpr auto most = std::numeric_limits<std::uint64_t>::max();
    static constexpr std::array<Option, 12> options{{
        {"delay", read_delay},
        {"latency", read_delay},
        {"distribution",
         [](NetemWords& from, NetemSettings& to) {
             to.distribution = from.take("normal, pareto or uniform");
         }},
        {"loss", read_loss},
        {"drop", read_loss},
        {"duplicate", read_duplicate},
        {"corrupt", read_corrupt},
        {"reorder", read_reorder},
        {"gap", [](NetemWords& from, NetemSettings& to) { to.gap = from.count(1'000'000); }},
        {"rate", read_rate},
        {"limit", [](NetemWords& from, NetemSettings& to) { to.limit = from.count(1'000'000); }},
        {"seed",
         [](NetemWords& from, NetemSettings& to) { to.seed = base::Seed{from.count(most)}; }},
    }};
    const auto word = words.take("an option");
    const auto option = std::find_if(options.begin(), options.end(),
                                     [&](const Option& one) { return one.name == word; });
    if (option != options.end()) return option->read(words, said);
    if (word == "ecn" || word == "slot") {
        return words.complain(fmt::format("netem's {} cannot be emulated: leave it out", word));
    }
    static constexpr std::array<std::string_view, 10> usual{
        "delay",   "distribution", "loss", "duplicate", "corrupt",
        "reorder", "gap",          "rate", "limit",     "seed"};
    words.complain(
        fmt::format("unknown netem option '{}': {}", word, base::suggestion(word, usual)));
}

/// Sets the jitter, and the delay that belongs to it.
void put_delay(NetemWords& words, NetemSettings& said, Conditions& conditions)
{
    conditions.delay = constant(said.delay);
    if (said.jitter == base::Duration{0}) {
        if (!said.distribution.empty()) words.complain("a distribution needs a jitter");
        return;
    }
    const double sd = base::to_nanoseconds(said.jitter);
    if (said.distribution.empty() || said.distribution == "uniform") {
        conditions.jitter = uniform(said.jitter);
        if (!said.distribution.empty()) {
            said.warnings.emplace_back(
                "tc refuses \"distribution uniform\" although its manual has "
                "it; this is what netem does without a distribution");
        }
    } else if (said.distribution == "normal") {
        conditions.jitter.law = NormalLaw{{}, said.jitter};
    } else if (said.distribution == "pareto") {
        // Shape 3 as in netem's table: the sd is mean / sqrt(3).
        const auto mean = scaled(said.jitter, std::sqrt(3.0));
        if (mean > said.delay) {
            return words.complain(fmt::format("a pareto jitter of sd {} needs a delay of at least "
                                              "{}, or much of it would lie before zero",
                                              in_ms(sd), in_ms(base::to_nanoseconds(mean))));
        }
        conditions.delay = constant(said.delay - mean);
        conditions.jitter.law = ParetoLaw{mean, 3.0};
        said.warnings.push_back(fmt::format(
            "netem's table of pareto ends at 4 sd and has an sd of 0.82: netem would have made an "
            "sd of {}, not {}, and a mean {} lower",
            in_ms(0.82 * sd), in_ms(sd), in_ms(0.034 * sd)));
    } else {
        return words.complain(fmt::format("the distribution '{0}' is not built in: use a profile "
                                          "with jitter = {{ law = \"table\", file = \"{0}.dist\", "
                                          "sd = ... }}",
                                          said.distribution));
    }
    if (said.distribution != "uniform" && !said.distribution.empty()) return;
    if (said.jitter > said.delay) {
        said.warnings.push_back("the jitter is larger than the delay: what would leave before it "
                                "came leaves at once, here and in netem");
    }
}

void put_correlation(NetemWords& words, NetemSettings& said, Conditions& conditions)
{
    const double correlation = said.delay_correlation.fraction();
    if (correlation == 0.0 || said.jitter == base::Duration{0}) return;
    if (correlation == 1.0) return words.complain("a correlation of 100% never changes");
    conditions.jitter.correlation_time = scaled(packet_spacing, -1.0 / std::log(correlation));
    said.warnings.push_back(fmt::format(
        "netem's correlation of delays has no effect (it takes the low bits, which are "
        "independent); here it is done: correlation_time = {}, which is {} from one packet to the "
        "next at 1000 packets/s",
        in_ms(base::to_nanoseconds(conditions.jitter.correlation_time)),
        base::to_text(said.delay_correlation)));
}

void put_order(const NetemSettings& said, Conditions& conditions,
               std::vector<std::string>& warnings)
{
    if (said.jitter == base::Duration{0}) return;
    if (said.rate.bits_per_second > 0) {
        warnings.emplace_back("a rate keeps the order of the packets in netem, which lengthens the "
                              "mean delay under jitter (order = keep)");
        return;
    }
    conditions.order = Order::free;
    warnings.emplace_back("netem's jitter reorders, also with a pfifo below it, so order = "
                          "\"free\" is set; most real paths do not reorder: for those use "
                          "order = \"keep\" with a correlation_time");
}

void put_reorder(NetemWords& words, NetemSettings& said, Conditions& conditions)
{
    if (!said.reorder && said.gap == 1) return;
    if (said.delay == base::Duration{0}) return words.complain("reorder needs a delay");
    if (said.jitter != base::Duration{0}) {
        return words.complain("reorder together with jitter is not possible here: jitter reorders "
                              "by itself");
    }
    if (said.gap == 0) return words.complain("gap is at least 1");
    const double share = said.reorder ? said.reorder->fraction() : 1.0;
    if (share == 0.0) return;
    // After gap - 1 packets each further one leaves at once with this probability, and then the
    // counting begins again.
    const double at_once = 1.0 / (static_cast<double>(said.gap - 1) + 1.0 / share);
    conditions.delay = constant(base::Duration{0});
    conditions.reorder = {Probability::from_fraction(1.0 - at_once).value(), {0, said.delay}};
    said.warnings.push_back(
        fmt::format("reorder lets {:.3g} % leave at once, the others {} behind their turn{}",
                    100.0 * at_once, in_ms(base::to_nanoseconds(said.delay)),
                    said.gap > 1 ? "; netem counts the gap, here each is drawn on its own" : ""));
}

void warn_of_limit(NetemSettings& said)
{
    if (said.delay == base::Duration{0}) return;
    const double rate = static_cast<double>(said.limit) / base::to_seconds(said.delay);
    const double usual = 1.0 / base::to_seconds(packet_spacing);
    if (rate > usual && said.limit == 1000) return;
    said.warnings.push_back(fmt::format(
        "netem's limit of {} counts packets that are being delayed: above {:.4g} packets/s it "
        "would drop; here nothing is dropped for being delayed",
        said.limit, rate));
}

} // namespace

base::Result<NetemProfile> parse_netem(std::string_view sentence)
{
    NetemWords words{sentence};
    if (words.at_end())
        return base::fail("the sentence is empty: write, for example, \"delay 80ms loss 1%\"");
    NetemSettings said;
    while (!words.at_end() && !words.complaint()) read_option(words, said);
    NetemProfile profile;
    Conditions& conditions = profile.conditions;
    if (!words.complaint()) {
        put_delay(words, said, conditions);
        put_correlation(words, said, conditions);
        put_order(said, conditions, said.warnings);
        put_reorder(words, said, conditions);
        warn_of_limit(said);
    }
    if (words.complaint()) return base::fail(*words.complaint());
    conditions.loss = said.loss;
    conditions.corrupt = said.corrupt;
    conditions.duplicate = said.duplicate;
    if (said.rate.bits_per_second > 0) {
        conditions.rate = said.rate;
        // netem's queue counts packets. They count with full size here, so that the limit is not
        // too strict.
        conditions.rate.queue_bytes_max = static_cast<std::size_t>(said.limit) * 1514;
    }
    for (const auto& time : words.bare_times()) {
        profile.warnings.push_back(fmt::format("{} without a unit is {} us to tc", time, time));
    }
    profile.warnings.insert(profile.warnings.end(), said.warnings.begin(), said.warnings.end());
    profile.seed = said.seed;
    return profile;
}

double netem_correlated_share(double share, double correlation)
{
    if (correlation <= 0.0 || share <= 0.0 || share >= 1.0) return std::clamp(share, 0.0, 1.0);
    constexpr std::size_t steps = 4096;
    constexpr double width = 1.0 / static_cast<double>(steps);
    const double rho = std::min(correlation, 0.999);
    // F(x) = P(X <= x) on a grid, and its integral. F is iterated to convergence: the new F is the
    // mean of F over the X' that lead to X <= x.
    std::vector<double> f(steps + 1);
    std::vector<double> sum(steps + 1);
    for (std::size_t i = 0; i <= steps; ++i) f[i] = static_cast<double>(i) * width;
    const auto integral = [&](double x) {
        if (x <= 0.0) return 0.0;
        if (x >= 1.0) return sum[steps] + (x - 1.0);
        const auto i = std::min(static_cast<std::size_t>(x / width), steps - 1);
        const double part = x / width - static_cast<double>(i);
        const double here = f[i] + (f[i + 1] - f[i]) * part;
        return sum[i] + 0.5 * (f[i] + here) * part * width;
    };
    constexpr int rounds_max = 3000;
    for (int round = 0; round < rounds_max; ++round) {
        sum[0] = 0.0;
        for (std::size_t i = 0; i < steps; ++i)
            sum[i + 1] = sum[i] + 0.5 * width * (f[i] + f[i + 1]);
        std::vector<double> next(steps + 1);
        double change = 0.0;
        for (std::size_t i = 0; i <= steps; ++i) {
            const double x = static_cast<double>(i) * width;
            const double all = integral(x / rho) - integral((x - (1.0 - rho)) / rho);
            next[i] = std::clamp(all * rho / (1.0 - rho), 0.0, 1.0);
            change = std::max(change, std::abs(next[i] - f[i]));
        }
        f = std::move(next);
        if (change < 1e-9) break;
    }
    const double place = share / width;
    const auto i = std::min(static_cast<std::size_t>(place), steps - 1);
    return f[i] + (f[i + 1] - f[i]) * (place - static_cast<double>(i));
}

} // namespace hapnet::emulator::tools
