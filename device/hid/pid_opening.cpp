// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hid/pid_opening.hpp"

#include "device/hid/pid_reports.hpp"
#include "device/hid/usages.hpp"

#include <string>

namespace hapnet::device::hid {

namespace {

// The number of requests for the block: some devices need a moment to allocate it. The kernel's own
// driver (hid-pidff) also asks 60 times.
constexpr int load_questions_max = 60;
// The number of missing answers: the kernel takes 5 s to give up each one.
constexpr int silences_max = 3;
constexpr int stops_said = 3;

tl::unexpected<DeviceError> refused(TransferResult moved, const std::string& what)
{
    if (moved == TransferResult::gone) {
        return device_error(Fault::disconnected,
                            "the device went away: plug it in and start again");
    }
    return device_error(Fault::communication,
                        "the device refuses " + what + ": unplug it, plug it in and start again");
}

Opened<std::uint32_t> load_effect(Wire& wire, const ForceLayout& layout)
{
    const Report create = create_report(layout);
    if (const TransferResult moved = wire.set_feature(create.all()); moved != TransferResult::yes) {
        return refused(moved, "a new effect");
    }
    int silences = 0;
    for (int i = 0; i < load_questions_max && silences < silences_max; ++i) {
        Report answer{layout.block_load.place};
        const TransferResult moved = wire.get_feature(answer.all());
        if (moved == TransferResult::gone) return refused(moved, "");
        if (moved != TransferResult::yes) {
            ++silences;
            continue;
        }
        const BlockLoadResult loaded = read_block_load(layout, answer);
        if (loaded.load == Load::success) return loaded.block;
        if (loaded.load == Load::full) {
            return device_error(Fault::in_use, "the device has no room for another effect: end the "
                                               "programs that play effects on it, or unplug it and "
                                               "plug it in again");
        }
    }
    return refused(TransferResult::failed, "to make room for an effect");
}

class Preparation {
public:
    Preparation(Wire& wire, const ForceLayout& layout) : wire_{wire}, layout_{layout} {}

    Opened<Prepared> run(std::size_t axes)
    {
        Prepared prepared;
        write(control_report(layout_, usage::device_reset));
        write(control_report(layout_, usage::stop_all_effects));
        for (std::size_t axis = 0; axis < axes && moved_ == TransferResult::yes; ++axis) {
            const auto block = load_effect(wire_, layout_);
            if (!block) {
                clean_up(prepared);
                return tl::unexpected{block.error()};
            }
            prepared.blocks.push_back(*block);
            write(set_effect_report(layout_, *block, axis == 0 ? Axis::right : Axis::away));
            write(level_report(layout_, *block, 0.0));
        }
        if (const auto gain = gain_report(layout_)) write(*gain);
        // Some devices enable their actuators by themselves when an effect is set.
        write(control_report(layout_, usage::disable_actuators));
        if (const TransferResult moved = moved_; moved != TransferResult::yes) {
            clean_up(prepared);
            return refused(moved, "an effect");
        }
        return prepared;
    }

private:
    void write(const Report& report)
    {
        if (moved_ == TransferResult::yes) moved_ = wire_.write(report.all());
    }

    /// Cleans up until the device does not accept a report, because each further report would take
    /// 5 s.
    void clean_up(const Prepared& prepared)
    {
        moved_ = TransferResult::yes;
        for (int i = 0; i < stops_said; ++i) {
            write(control_report(layout_, usage::stop_all_effects));
            write(control_report(layout_, usage::disable_actuators));
        }
        for (const std::uint32_t block : prepared.blocks) {
            const auto report = free_report(layout_, block);
            if (report) write(*report);
        }
    }

    Wire& wire_;
    const ForceLayout& layout_;
    TransferResult moved_ = TransferResult::yes; // result of all writes so far
};

} // namespace

Opened<Prepared> prepare(Wire& wire, const ForceLayout& layout, std::size_t axes)
{
    return Preparation{wire, layout}.run(axes);
}

} // namespace hapnet::device::hid
