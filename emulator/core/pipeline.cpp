// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/pipeline.hpp"

#include "emulator/core/path_name.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator {

namespace {

base::RandomStream stream_of(base::Seed seed, std::string_view way, std::string_view stage)
{
    return seed.stream(fmt::format("{}/{}", way, stage));
}

/// True if the drawn share of all datagrams includes this one. An absent stage draws nothing.
bool is_drawn(base::Probability share, const base::RandomStream& stream, std::uint64_t number)
{
    return share.fraction() > 0 && stream.uniform(number) < share.fraction();
}

} // namespace

/// The running regimes of a direction.
struct Pipeline::InRegimes {
    Regimes said;
    RegimeChain chain;
    std::vector<Pipeline> stages; // one for each regime, with only its own settings
};

Pipeline::~Pipeline() = default;
Pipeline::Pipeline(Pipeline&&) noexcept = default;
Pipeline& Pipeline::operator=(Pipeline&&) noexcept = default;

Pipeline::Pipeline(const Pipeline& other)
    : seed_{other.seed_},
      way_{other.way_},
      both_ways_{other.both_ways_},
      mtu_{other.mtu_},
      loss_{other.loss_},
      corrupt_{other.corrupt_},
      corrupt_stream_{other.corrupt_stream_},
      duplicate_{other.duplicate_},
      duplicate_stream_{other.duplicate_stream_},
      delay_{other.delay_},
      jitter_{other.jitter_},
      reorder_{other.reorder_},
      reorder_stream_{other.reorder_stream_},
      regimes_{other.regimes_ ? std::make_unique<InRegimes>(*other.regimes_) : nullptr}
{}

Pipeline::Pipeline(const Conditions& conditions, base::Seed seed, Direction direction,
                   std::string_view path)
    : Pipeline{conditions, seed, stream_name(path, direction), stream_name_of_both(path)}
{}

Pipeline::Pipeline(const Conditions& conditions, base::Seed seed, std::string way,
                   std::string both_ways)
    : seed_{seed},
      way_{std::move(way)},
      both_ways_{std::move(both_ways)},
      mtu_{conditions.mtu},
      corrupt_{conditions.corrupt},
      corrupt_stream_{stream_of(seed, way_, "corrupt")},
      duplicate_{conditions.duplicate},
      duplicate_stream_{stream_of(seed, way_, "duplicate")},
      delay_{conditions.delay, stream_of(seed, way_, "delay")},
      jitter_{conditions.jitter, stream_of(seed, way_, "jitter")},
      reorder_{conditions.reorder},
      reorder_stream_{stream_of(seed, way_, "reorder")}
{
    change_losses(conditions.loss);
    change_regimes(conditions.regimes);
}

Fate Pipeline::own_fate(const Packet& packet)
{
    Fate fate;
    if (is_above_mtu(packet)) fate.drop = DropCause::mtu;
    for (std::size_t i = 0; i < loss_.size(); ++i) {
        const auto lost = loss_[i].process.on_packet(packet);
        fate.states[i] = loss_[i].process.state();
        if (!fate.drop) fate.drop = lost;
    }
    // Delays may depend on the previous ones, so they are also drawn for lost datagrams.
    const auto delay = delay_.on_packet(packet) + jitter_.on_packet(packet);
    if (fate.drop) return fate;
    corrupt(fate, packet.number);
    duplicate(fate, packet.number);
    fate.delay = std::max(delay, base::Duration{0});
    reorder(fate, packet.number);
    return fate;
}

Fate Pipeline::fate_at(const Packet& packet)
{
    return on_packet(packet, regimes_->chain.at(packet.at));
}

Fate Pipeline::on_packet(const Packet& packet, std::size_t regime)
{
    base::ensure(regimes_ != nullptr);
    const Patch& sets = regimes_->said.all[regime].own;
    Draws chosen = draw(packet);
    for (std::size_t i = 0; i < regimes_->stages.size(); ++i) {
        const Draws own = regimes_->stages[i].draw(packet);
        if (i != regime) continue;
        if (sets.loss) {
            chosen.lost = own.lost;
            chosen.states = own.states;
        }
        if (sets.delay) chosen.delay = own.delay;
        if (sets.jitter) chosen.jitter = own.jitter;
    }
    Fate fate{.drop = chosen.lost,
              .regime = static_cast<std::uint8_t>(regime + 1),
              .states = chosen.states};
    if (is_above_mtu(packet)) fate.drop = DropCause::mtu;
    if (fate.drop) return fate;
    const Pipeline& stages = regimes_->stages[regime];
    (sets.corrupt ? stages : *this).corrupt(fate, packet.number);
    (sets.duplicate ? stages : *this).duplicate(fate, packet.number);
    fate.delay = std::max(chosen.delay + chosen.jitter, base::Duration{0});
    reorder(fate, packet.number);
    return fate;
}

/// Shows the datagram to all stages that have a memory.
Pipeline::Draws Pipeline::draw(const Packet& packet)
{
    Draws draws;
    for (std::size_t i = 0; i < loss_.size(); ++i) {
        const auto lost = loss_[i].process.on_packet(packet);
        draws.states[i] = loss_[i].process.state();
        if (!draws.lost) draws.lost = lost;
    }
    draws.delay = delay_.on_packet(packet);
    draws.jitter = jitter_.on_packet(packet);
    return draws;
}

void Pipeline::corrupt(Fate& fate, std::uint64_t number) const
{
    if (is_drawn(corrupt_.share, corrupt_stream_, number)) fate.flips = draw_flips(number);
}

void Pipeline::duplicate(Fate& fate, std::uint64_t number) const
{
    if (is_drawn(duplicate_.share, duplicate_stream_, number)) fate.copy_after = draw_copy(number);
}

void Pipeline::reorder(Fate& fate, std::uint64_t number) const
{
    if (is_drawn(reorder_.share, reorder_stream_, number)) {
        fate.displacement = reorder_.displacement;
    }
}

std::optional<RegimeChain> Pipeline::chain() const
{
    if (regimes_ == nullptr) return std::nullopt;
    const Regimes& said = regimes_->said;
    return RegimeChain{said, stream_of(seed_, said.are_together ? both_ways_ : way_, "regime")};
}

std::vector<RegimeCourse> Pipeline::regime_course(base::Duration until) const
{
    if (regimes_ == nullptr) return {};
    return regimes_->chain.course(until);
}

/// Changes the regimes. If the course stays the same, it continues, whatever the regimes set.
void Pipeline::change_regimes(const Regimes& regimes)
{
    if (regimes.empty()) return regimes_.reset();
    const std::vector<Regime>& all = regimes.all.get();
    if (regimes_ && have_same_course(regimes_->said, regimes)) {
        for (std::size_t i = 0; i < all.size(); ++i) {
            regimes_->stages[i].change(patched({}, all[i].own));
        }
        regimes_->said = regimes;
        return;
    }
    const auto& way = regimes.are_together ? both_ways_ : way_;
    regimes_ = std::make_unique<InRegimes>(
        InRegimes{regimes, RegimeChain{regimes, stream_of(seed_, way, "regime")}, {}});
    for (const Regime& regime : all) {
        regimes_->stages.push_back(Pipeline{patched({}, regime.own), seed_,
                                            fmt::format("{}/regime/{}", way_, regime.name),
                                            both_ways_});
    }
}

bool Pipeline::is_above_mtu(const Packet& packet) const
{
    return mtu_.bytes_max > 0 && packet.bytes + Mtu::header_bytes > mtu_.bytes_max;
}

Flips Pipeline::draw_flips(std::uint64_t number) const
{
    Flips flips;
    flips.count = corrupt_.bits;
    for (std::uint32_t i = 0; i < corrupt_.bits; ++i) {
        flips.places[i] = static_cast<std::uint32_t>(corrupt_stream_.bits(number, 1 + i) >> 32);
    }
    return flips;
}

/// Returns the time after the original at which the copy leaves.
base::Duration Pipeline::draw_copy(std::uint64_t number) const
{
    const auto spread = static_cast<double>(duplicate_.spread.count());
    return base::Duration{
        static_cast<base::Duration::rep>(duplicate_stream_.uniform(number, 1) * spread)};
}

base::RandomStream Pipeline::stream(std::string_view stage) const
{
    return stream_of(seed_, way_, stage);
}

void Pipeline::change(const Conditions& conditions)
{
    mtu_ = conditions.mtu;
    corrupt_ = conditions.corrupt;
    duplicate_ = conditions.duplicate;
    reorder_ = conditions.reorder;
    delay_.change(conditions.delay);
    jitter_.change(conditions.jitter);
    change_losses(conditions.loss);
    if (regimes_ || !conditions.regimes.empty()) change_regimes(conditions.regimes);
}

Pipeline::LawIndex Pipeline::index_of(const std::vector<LossLaw>& laws, std::size_t index)
{
    const auto end = laws.begin() + static_cast<std::ptrdiff_t>(index);
    const auto before = std::count_if(
        laws.begin(), end, [&](const LossLaw& law) { return law.index() == laws[index].index(); });
    return {laws[index].index(), static_cast<std::size_t>(before) + 1};
}

/// Its stream is "loss/random", "loss/random#2", ...: numbered within a kind, so that adding or
/// removing a law of another kind does not shift the streams.
Pipeline::LossStage Pipeline::loss_stage(const std::vector<LossLaw>& laws, std::size_t index) const
{
    const LawIndex position = index_of(laws, index);
    auto name = fmt::format("loss/{}", name_of(laws[index]));
    if (position.occurrence > 1) name += fmt::format("#{}", position.occurrence);
    return {position, {laws[index], stream_of(seed_, way_, name)}};
}

void Pipeline::change_losses(const std::vector<LossLaw>& laws)
{
    base::ensure(laws.size() <= loss_laws_max);
    bool is_same = laws.size() == loss_.size();
    for (std::size_t i = 0; i < laws.size() && is_same; ++i) {
        is_same = loss_[i].position == index_of(laws, i);
    }
    if (!is_same) {
        std::vector<LossStage> stages;
        for (std::size_t i = 0; i < laws.size(); ++i) {
            const auto old = std::find_if(loss_.begin(), loss_.end(), [&](const LossStage& stage) {
                return stage.position == index_of(laws, i);
            });
            stages.push_back(old == loss_.end() ? loss_stage(laws, i) : *old);
        }
        loss_ = std::move(stages);
    }
    for (std::size_t i = 0; i < laws.size(); ++i) loss_[i].process.change(laws[i]);
}

} // namespace hapnet::emulator
