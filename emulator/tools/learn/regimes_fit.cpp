// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/learn/regimes_fit.hpp"

#include "proto/base/ensure.hpp"
#include "proto/base/math.hpp"
#include "proto/base/random.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace hapnet::emulator::tools {

namespace {

constexpr std::size_t most_regimes = 4;
constexpr std::size_t most_classes = 32;
constexpr std::size_t rows_to_begin = 20'000; // used by the first tries
constexpr std::size_t rows_to_choose = 200'000;
constexpr std::size_t rows_min = 200;
constexpr double exits_min = 10.0;

// Symbols: a class of delays, then these two.
constexpr std::uint8_t lost_symbol = most_classes;
constexpr std::uint8_t unknown_symbol = most_classes + 1;
constexpr std::size_t symbols = most_classes + 1; // symbols that a state can emit

/// A series in which delays are replaced by their classes.
struct Series {
    std::vector<std::uint8_t> rows{};
    std::size_t classes = 0;
    std::array<double, most_classes> mean{}; // delay in each, in ns
    std::array<double, symbols> share{};     // share of all rows
};

/// Classes of sorted delays. Classes of equal numbers alone would put the slowest delays of a good
/// regime and the few delays of a rare bad one into the same class, which would make them
/// indistinguishable. So half of the classes have equal numbers, and the others divide the widest
/// classes.
class Classes {
public:
    /// Makes at most `most` classes. `sorted` has at least one delay.
    Classes(const std::vector<double>& sorted, std::size_t most) : sorted_{sorted}
    {
        sum_logarithms();
        for (std::size_t i = 1; i < most / 2; ++i) cut_at(sorted.size() * i / (most / 2));
        std::vector<Cut> cuts;
        for (std::size_t i = 0; i + 1 < ends_.size(); ++i)
            cuts.push_back(best_cut(ends_[i], ends_[i + 1]));
        while (ends_.size() <= most) {
            const auto best = std::ranges::max_element(cuts, {}, &Cut::gain);
            if (best->gain <= 0.0) break;
            const std::size_t place = best->place;
            const auto after = ends_.insert(std::ranges::lower_bound(ends_, place), place);
            *best = best_cut(*(after - 1), place);
            cuts.insert(best + 1, best_cut(place, *(after + 1)));
        }
    }

    /// Returns the edges. Each class except the first begins above an edge.
    [[nodiscard]] std::vector<double> edges() const
    {
        std::vector<double> edges;
        for (std::size_t i = 1; i + 1 < ends_.size(); ++i) edges.push_back(sorted_[ends_[i] - 1]);
        return edges;
    }

private:
    static constexpr std::size_t delays_min = 10; // fewest delays in a class

    struct Cut {
        std::size_t place = 0;
        double gain = 0.0; // reduction of squared deviations within classes
    };

    /// Sums the logarithms of the distance from the least delay. Deviations are those of
    /// logarithms, so that a long tail does not use up all classes.
    void sum_logarithms()
    {
        const double least = sorted_.front();
        const double scale = std::max(sorted_[sorted_.size() / 2] - least, 1e3);
        for (const double delay : sorted_)
            sums_.push_back(sums_.back() + base::log(delay - least + scale) - base::log(scale));
    }

    /// Ends a class at the first position from `place` on at which the delay changes.
    void cut_at(std::size_t place)
    {
        place = std::max<std::size_t>(place, 1);
        while (place < sorted_.size() && sorted_[place] == sorted_[place - 1]) ++place;
        const std::size_t before = ends_[ends_.size() - 2];
        if (place < sorted_.size() && place > before) ends_.insert(ends_.end() - 1, place);
    }

    /// Returns the position at which one-dimensional k-means would divide the class of these
    /// delays.
    [[nodiscard]] Cut best_cut(std::size_t begin, std::size_t end) const
    {
        Cut best;
        for (std::size_t i = begin + delays_min; i + delays_min <= end; ++i) {
            if (sorted_[i] == sorted_[i - 1]) continue;
            const auto left = static_cast<double>(i - begin);
            const auto right = static_cast<double>(end - i);
            const double apart = (sums_[end] - sums_[i]) / right - (sums_[i] - sums_[begin]) / left;
            const double gain = apart * apart * left * right / (left + right);
            if (gain > best.gain) best = {i, gain};
        }
        return best;
    }

    const std::vector<double>& sorted_;
    std::vector<double> sums_{0.0};                    // sums of the logarithms before each delay
    std::vector<std::size_t> ends_{0, sorted_.size()}; // where the classes end
};

Series series_of(const MeasuredWay& way)
{
    std::vector<double> sorted;
    for (const auto& delay : way.delays) {
        if (delay) sorted.push_back(base::to_nanoseconds(*delay));
    }
    std::sort(sorted.begin(), sorted.end());
    const auto fitting =
        static_cast<std::size_t>(std::sqrt(static_cast<double>(sorted.size())) / 4);
    const std::size_t most = std::clamp(fitting, std::size_t{4}, most_classes);
    const auto edges = sorted.empty() ? std::vector<double>{} : Classes{sorted, most}.edges();
    Series series{.classes = edges.size() + 1};
    std::array<double, most_classes> counts{};
    for (std::size_t i = 0; i < way.delays.size(); ++i) {
        const auto& delay = way.delays[i];
        std::uint8_t symbol = way.lost[i] ? lost_symbol : unknown_symbol;
        if (delay) {
            const double value = base::to_nanoseconds(*delay);
            const auto place = std::lower_bound(edges.begin(), edges.end(), value);
            symbol = static_cast<std::uint8_t>(place - edges.begin());
            counts[symbol] += 1.0;
            series.mean[symbol] += value;
        }
        series.rows.push_back(symbol);
        if (symbol < symbols) series.share[symbol] += 1.0;
    }
    for (std::size_t i = 0; i < most_classes; ++i) series.mean[i] /= std::max(counts[i], 1.0);
    for (double& one : series.share) one /= static_cast<double>(way.delays.size());
    return series;
}

/// A hidden Markov chain, improved by rounds of Baum and Welch's algorithm (Rabiner, Proceedings of
/// the IEEE 77, 1989, section V.A has the scaling).
template <std::size_t K>
class HiddenChain {
public:
    using Vector = std::array<double, K>;

    Vector begin{};
    std::array<Vector, K> steps{};
    std::array<Vector, symbols> emits{}; // [symbol][state]
    std::array<Vector, K> counts{};      // expected steps from state to state
    double log_likelihood = -std::numeric_limits<double>::infinity();

    /// Returns states that each have the delays between two shares of all, and equal shares of
    /// losses.
    static HiddenChain split(const Series& series, const Vector& upper)
    {
        HiddenChain chain;
        double before = 0.0;
        double delays = 0.0;
        for (std::size_t c = 0; c < series.classes; ++c) delays += series.share[c];
        for (std::size_t c = 0; c < series.classes; ++c) {
            const double middle = (before + 0.5 * series.share[c]) / delays;
            before += series.share[c];
            for (std::size_t k = 0; k < K; ++k) {
                const double lower = k == 0 ? 0.0 : upper[k - 1];
                const bool is_inside = middle >= lower && middle < upper[k];
                chain.emits[c][k] = series.share[c] * (is_inside ? 1.0 : 0.05);
            }
        }
        chain.emits[lost_symbol].fill(series.share[lost_symbol]);
        return chain.made_ready();
    }

    /// Returns states with equal delays and increasing losses.
    static HiddenChain losing(const Series& series)
    {
        HiddenChain chain;
        for (std::size_t c = 0; c < series.classes; ++c) chain.emits[c].fill(series.share[c]);
        for (std::size_t k = 0; k < K; ++k) {
            const double much = static_cast<double>(k) / static_cast<double>(K);
            chain.emits[lost_symbol][k] = 0.5 * series.share[lost_symbol] + much;
        }
        return chain.made_ready();
    }

    /// Makes one round over the first `count` rows.
    void improve(const Series& series, std::size_t count)
    {
        forward(series, count);
        std::array<Vector, symbols> sums{};
        Vector first{};
        counts = {};
        backward(series, count, [&](std::size_t row, const Vector& share) {
            const auto symbol = series.rows[row];
            if (symbol < symbols) {
                for (std::size_t k = 0; k < K; ++k) sums[symbol][k] += share[k];
            }
            if (row == 0) first = share;
        });
        begin = first;
        for (std::size_t i = 0; i < K; ++i) {
            const double all = std::accumulate(counts[i].begin(), counts[i].end(), 0.0);
            if (all <= 0.0) continue;
            for (std::size_t j = 0; j < K; ++j) steps[i][j] = counts[i][j] / all;
        }
        emits = sums;
        smooth(series);
    }

    /// Calls use(row, shares of the states) for each row, from the last one to the first.
    void visit(const Series& series, const auto& use)
    {
        forward(series, series.rows.size());
        counts = {};
        backward(series, series.rows.size(), use);
    }

private:
    HiddenChain& made_ready()
    {
        begin.fill(1.0 / static_cast<double>(K));
        for (std::size_t i = 0; i < K; ++i) {
            for (std::size_t j = 0; j < K; ++j) {
                steps[i][j] =
                    i == j ? 0.95 : 0.05 / static_cast<double>(std::max<std::size_t>(K - 1, 1));
            }
            if (K == 1) steps[i][i] = 1.0;
        }
        normalise();
        return *this;
    }

    /// Ensures that no class is impossible only because it did not occur.
    void smooth(const Series& series)
    {
        constexpr double prior_rows = 0.5;
        for (std::size_t s = 0; s < symbols; ++s) {
            for (double& one : emits[s]) one += prior_rows * series.share[s];
        }
        normalise();
    }

    void normalise()
    {
        for (std::size_t k = 0; k < K; ++k) {
            double sum = 0.0;
            for (const Vector& of_symbol : emits) sum += of_symbol[k];
            for (Vector& of_symbol : emits) of_symbol[k] /= sum;
        }
    }

    [[nodiscard]] const Vector& emission(std::uint8_t symbol) const
    {
        static constexpr Vector ones = [] {
            Vector all{};
            all.fill(1.0);
            return all;
        }();
        return symbol < symbols ? emits[symbol] : ones;
    }

    void forward(const Series& series, std::size_t count)
    {
        ahead_.resize(count);
        scale_.resize(count);
        log_likelihood = 0.0;
        double product = 1.0; // product of scales: saves logarithms
        Vector now = begin;
        for (std::size_t row = 0; row < count; ++row) {
            if (row > 0) {
                Vector next{};
                for (std::size_t i = 0; i < K; ++i) {
                    for (std::size_t j = 0; j < K; ++j) next[j] += now[i] * steps[i][j];
                }
                now = next;
            }
            const Vector& emit = emission(series.rows[row]);
            double sum = 0.0;
            for (std::size_t k = 0; k < K; ++k) sum += now[k] *= emit[k];
            sum = std::max(sum, 1e-200);
            for (double& one : now) one /= sum;
            ahead_[row] = now;
            scale_[row] = sum;
            product *= sum;
            if (product < 1e-100) {
                log_likelihood += base::log(product);
                product = 1.0;
            }
        }
        log_likelihood += base::log(product);
    }

    /// Runs the backward pass. Call it after forward().
    void backward(const Series& series, std::size_t count, const auto& use)
    {
        Vector behind{};
        behind.fill(1.0);
        for (std::size_t row = count; row-- > 0;) {
            Vector share;
            for (std::size_t k = 0; k < K; ++k) share[k] = ahead_[row][k] * behind[k];
            use(row, share);
            if (row == 0) break;
            const Vector& emit = emission(series.rows[row]);
            Vector weighed;
            for (std::size_t j = 0; j < K; ++j) weighed[j] = emit[j] * behind[j] / scale_[row];
            Vector before{};
            for (std::size_t i = 0; i < K; ++i) {
                for (std::size_t j = 0; j < K; ++j) {
                    const double way = steps[i][j] * weighed[j];
                    before[i] += way;
                    counts[i][j] += ahead_[row - 1][i] * way;
                }
            }
            behind = before;
        }
    }

    std::vector<Vector> ahead_{};
    std::vector<double> scale_{};
};

/// Improves the chain until the gain is negligible.
template <std::size_t K>
void climb(HiddenChain<K>& chain, const Series& series, std::size_t rows, int rounds)
{
    const std::size_t count = std::min(rows, series.rows.size());
    double last = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < rounds; ++i) {
        chain.improve(series, count);
        if (chain.log_likelihood - last < 1e-7 * static_cast<double>(count)) break;
        last = chain.log_likelihood;
    }
}

template <std::size_t K>
std::vector<HiddenChain<K>> beginnings(const Series& series)
{
    using Of = HiddenChain<K>;
    if constexpr (K == 1) {
        return {Of::split(series, {1.1})};
    } else if constexpr (K == 2) {
        return {Of::split(series, {0.5, 1.1}), Of::split(series, {0.8, 1.1}),
                Of::split(series, {0.95, 1.1}), Of::losing(series)};
    } else if constexpr (K == 3) {
        return {Of::split(series, {0.33, 0.67, 1.1}), Of::split(series, {0.5, 0.9, 1.1}),
                Of::split(series, {0.8, 0.97, 1.1}), Of::losing(series)};
    } else {
        return {Of::split(series, {0.25, 0.5, 0.75, 1.1}),
                Of::split(series, {0.5, 0.8, 0.95, 1.1})};
    }
}

/// Returns the best result of several starting points, improved on `rows` rows.
template <std::size_t K>
HiddenChain<K> best_chain(const Series& series, std::size_t rows)
{
    constexpr int tries = 15;
    constexpr int rounds = 150;
    auto chains = beginnings<K>(series);
    for (HiddenChain<K>& chain : chains) climb(chain, series, rows_to_begin, tries);
    auto best = std::ranges::max_element(chains, {}, &HiddenChain<K>::log_likelihood);
    climb(*best, series, rows, rounds);
    return std::move(*best);
}

/// Returns the BIC. It can be compared between chains with equal classes. The chain was fitted to
/// the first `rows` rows, or to all if there are fewer.
template <std::size_t K>
double bic_of(const HiddenChain<K>& chain, const Series& series, std::size_t rows)
{
    const bool has_losses = series.share[lost_symbol] > 0.0;
    const auto each = static_cast<double>(series.classes - 1 + (has_losses ? 1 : 0) + K - 1);
    const double parameters = each * static_cast<double>(K) + static_cast<double>(K - 1);
    const auto count = static_cast<double>(std::min(rows, series.rows.size()));
    return parameters * base::log(count) - 2.0 * chain.log_likelihood;
}

/// Returns the rates of a chain in time from the steps of this chain from row to row: the logarithm
/// of the matrix, whose series converges fast if states last many rows. nullopt: they do not.
template <std::size_t K>
std::optional<std::array<std::array<double, K>, K>>
rates_of(const std::array<std::array<double, K>, K>& steps)
{
    using Matrix = std::array<std::array<double, K>, K>;
    Matrix less = steps;
    for (std::size_t i = 0; i < K; ++i) {
        if (steps[i][i] < 0.6) return std::nullopt;
        less[i][i] -= 1.0;
    }
    Matrix power = less;
    Matrix sum = less;
    constexpr int terms = 60;
    for (int n = 2; n <= terms; ++n) {
        Matrix next{};
        for (std::size_t i = 0; i < K; ++i) {
            for (std::size_t k = 0; k < K; ++k) {
                for (std::size_t j = 0; j < K; ++j) next[i][j] += power[i][k] * less[k][j];
            }
        }
        power = next;
        for (std::size_t i = 0; i < K; ++i) {
            for (std::size_t j = 0; j < K; ++j) {
                sum[i][j] += (n % 2 == 0 ? -1.0 : 1.0) / n * power[i][j];
            }
        }
    }
    for (std::size_t i = 0; i < K; ++i) {
        double out = 0.0;
        for (std::size_t j = 0; j < K; ++j) {
            if (i == j) continue;
            if (!std::isfinite(sum[i][j])) return std::nullopt;
            sum[i][j] = std::max(sum[i][j], 0.0); // an estimate may lie just outside
            out += sum[i][j];
        }
        if (K > 1 && out <= 0.0) return std::nullopt;
        sum[i][i] = -out;
    }
    return sum;
}

template <std::size_t K>
std::optional<RegimesFit> fit_chain(const Series& series, std::size_t rows)
{
    HiddenChain<K> chain = best_chain<K>(series, rows);
    const auto rates = rates_of<K>(chain.steps);
    if (!rates) return std::nullopt;
    RegimesFit found{.bic = bic_of(chain, series, rows)};
    found.log_likelihood = chain.log_likelihood;
    std::array<double, K> delay{};
    std::array<double, K> arrived{};
    found.regimes.resize(K);
    for (RegimeFit& one : found.regimes) one.is_own.resize(series.rows.size());
    const auto stream = base::Seed{0x2e91e5}.stream("learn/regimes");
    chain.visit(series, [&](std::size_t row, const std::array<double, K>& share) {
        const auto symbol = series.rows[row];
        double u = stream.uniform(row);
        std::size_t drawn = 0;
        while (drawn + 1 < K && u >= share[drawn]) u -= share[drawn++];
        for (std::size_t k = 0; k < K; ++k) {
            found.regimes[k].rows += share[k];
            if (symbol == lost_symbol) found.regimes[k].lost += share[k];
            if (symbol < lost_symbol) {
                delay[k] += share[k] * series.mean[symbol];
                arrived[k] += share[k];
            }
        }
        found.regimes[drawn].is_own[row] = 1;
    });
    std::array<std::size_t, K> order{};
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {},
                      [&](std::size_t k) { return delay[k] / std::max(arrived[k], 1.0); });
    std::vector<RegimeFit> sorted;
    for (const std::size_t k : order) {
        RegimeFit one = std::move(found.regimes[k]);
        const double out = -(*rates)[k][k];
        one.stay_rows = out > 0.0 ? 1.0 / out : static_cast<double>(series.rows.size());
        for (const std::size_t j : order) {
            one.followers.push_back(j == k || out <= 0.0 ? 0.0 : (*rates)[k][j] / out);
            if (j != k) one.exits += chain.counts[k][j];
        }
        if (K > 1 && (one.exits < exits_min || arrived[k] < exits_min)) return std::nullopt;
        sorted.push_back(std::move(one));
    }
    found.regimes = std::move(sorted);
    return found;
}

} // namespace

std::optional<RegimesFit> fit_regimes(const MeasuredWay& way, std::size_t count)
{
    base::ensure(count >= 1 && count <= most_regimes);
    if (way.delays.size() < rows_min) return std::nullopt;
    const Series series = series_of(way);
    const std::size_t rows = series.rows.size();
    if (count == 1) return fit_chain<1>(series, rows);
    if (count == 2) return fit_chain<2>(series, rows);
    return count == 3 ? fit_chain<3>(series, rows) : fit_chain<4>(series, rows);
}

std::size_t count_regimes(const MeasuredWay& way)
{
    if (way.delays.size() < rows_min || !way.spacing) return 1;
    const Series series = series_of(way);
    std::size_t best = 1;
    double least = std::numeric_limits<double>::infinity();
    const auto consider = [&](std::size_t count, const std::optional<RegimesFit>& fit) {
        if (!fit || fit->bic >= least) return;
        least = fit->bic;
        best = count;
    };
    consider(1, fit_chain<1>(series, rows_to_choose));
    consider(2, fit_chain<2>(series, rows_to_choose));
    consider(3, fit_chain<3>(series, rows_to_choose));
    consider(4, fit_chain<4>(series, rows_to_choose));
    return best;
}

} // namespace hapnet::emulator::tools
