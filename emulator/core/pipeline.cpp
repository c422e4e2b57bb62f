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

/// Whether a share of all datagrams includes this one. A stage that is absent draws nothing.
bool is_drawn(base::Probability share, const base::RandomStream& stream, std::uint64_t number)
{
    return share.fraction() > 0 && stream.uniform(number) < share.fraction();
}

} // namespace

Pipeline::Pipeline(const Conditions& conditions, base::Seed seed, Direction direction,
                   std::string_view path)
    : seed_{seed},
      way_{stream_name(path, direction)},
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
}

Fate Pipeline::on_packet(const Packet& packet)
{
    Fate fate;
    if (is_above_mtu(packet)) fate.drop = DropCause::mtu;
    for (std::size_t i = 0; i < loss_.size(); ++i) {
        const auto lost = loss_[i].process.on_packet(packet);
        fate.states[i] = loss_[i].process.state();
        if (!fate.drop) fate.drop = lost;
    }
    // Delays may depend on the ones before: they are drawn for what is lost, too.
    const auto delay = delay_.on_packet(packet) + jitter_.on_packet(packet);
    if (fate.drop) return fate;
    if (is_drawn(corrupt_.share, corrupt_stream_, packet.number)) {
        fate.flips = draw_flips(packet.number);
    }
    if (is_drawn(duplicate_.share, duplicate_stream_, packet.number)) {
        fate.copy_after = draw_copy(packet.number);
    }
    fate.delay = std::max(delay, base::Duration{0});
    if (is_drawn(reorder_.share, reorder_stream_, packet.number)) {
        fate.displacement = reorder_.displacement;
    }
    return fate;
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

/// How long after the original the copy leaves.
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
}

Pipeline::LawIndex Pipeline::index_of(const std::vector<LossLaw>& laws, std::size_t index)
{
    const auto end = laws.begin() + static_cast<std::ptrdiff_t>(index);
    const auto before = std::count_if(
        laws.begin(), end, [&](const LossLaw& law) { return law.index() == laws[index].index(); });
    return {laws[index].index(), static_cast<std::size_t>(before) + 1};
}

/// Its stream is "loss/random", "loss/random#2", ...: by kind, so that a law of another kind more
/// or less in the list shifts nothing.
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
