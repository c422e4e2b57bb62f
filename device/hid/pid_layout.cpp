// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hid/pid_layout.hpp"

#include "device/hid/usages.hpp"

#include <algorithm>
#include <initializer_list>
#include <spdlog/fmt/fmt.h>
#include <string>

namespace hapnet::device::hid {

namespace {

constexpr std::size_t buttons_max = 8;

/// True if all values of the field's logical range fit into its bits.
bool has_room(const Field& field)
{
    const std::int64_t values = std::int64_t{1} << field.bit_size;
    if (field.logical_min >= 0) return field.logical_max < values;
    return field.logical_min >= -values / 2 && field.logical_max < values / 2;
}

/// Looks for required fields, and remembers the first one that is missing.
class Search {
public:
    explicit Search(const Descriptor& descriptor) : descriptor_{descriptor} {}

    /// Searches from now on in reports of this kind with fields in this collection.
    void in(ReportKind kind, Usage collection, std::string_view report)
    {
        kind_ = kind;
        collection_ = collection;
        report_ = report;
        place_.reset();
    }
    /// Searches from now on in any report of this kind.
    void anywhere(ReportKind kind, std::string_view report) { in(kind, 0, report); }

    [[nodiscard]] std::optional<Field> optional(Usage variable)
    {
        return first(
            [&](const Field& field) { return is_variable_of(field, variable) && has_room(field); });
    }
    [[nodiscard]] Field field(Usage variable, std::string_view name)
    {
        return required(optional(variable), name);
    }
    /// Returns the first field inside another collection.
    [[nodiscard]] Field field_inside(Usage inner, std::string_view name)
    {
        return required(
            first([&](const Field& field) { return lies_in(field, inner) && has_room(field); }),
            name);
    }
    /// Returns the fields that select one of these choices.
    [[nodiscard]] Selector selector(std::initializer_list<Usage> choices, std::string_view name);
    /// Returns the report that contains the last fields found.
    [[nodiscard]] ReportPlace place() const { return place_.value_or(ReportPlace{}); }

    [[nodiscard]] const std::string& missing() const { return missing_; }

private:
    template <typename Condition>
    [[nodiscard]] std::optional<Field> first(Condition condition);
    [[nodiscard]] Field required(const std::optional<Field>& found, std::string_view name);

    const Descriptor& descriptor_;
    ReportKind kind_ = ReportKind::output;
    Usage collection_ = 0;
    std::string report_;
    std::optional<ReportPlace> place_;
    std::string missing_;
};

template <typename Condition>
std::optional<Field> Search::first(Condition condition)
{
    for (const Field& field : descriptor_.fields) {
        const bool is_here = field.kind == kind_ &&
                             (collection_ == 0 || lies_in(field, collection_)) &&
                             (!place_ || place_->id == field.report_id);
        if (!is_here || !condition(field)) continue;
        const std::size_t bytes = descriptor_.bytes_of(kind_, field.report_id);
        if (bytes >= report_bytes_max) continue;
        place_ = ReportPlace{field.report_id, bytes};
        return field;
    }
    return std::nullopt;
}

Field Search::required(const std::optional<Field>& found, std::string_view name)
{
    if (!found && missing_.empty()) missing_ = fmt::format("its {} has no {}", report_, name);
    return found.value_or(Field{});
}

Selector Search::selector(std::initializer_list<Usage> choices, std::string_view name)
{
    Selector selector;
    for (const Usage choice : choices) {
        const auto found = first([&](const Field& field) {
            return field.is_array ? has_room(field) && value_of(field, choice).has_value()
                                  : is_variable_of(field, choice);
        });
        Field field = required(found, name);
        const auto& known = selector.fields;
        if (std::find(known.begin(), known.end(), field) != known.end()) continue;
        selector.fields.push_back(std::move(field));
    }
    return selector;
}

ForceLayout::SetEffect find_set_effect(Search& search)
{
    search.in(ReportKind::output, usage::set_effect_report, "Set Effect report");
    ForceLayout::SetEffect report;
    report.block = search.field(usage::effect_block_index, "effect block index");
    report.type = search.selector({usage::constant_force}, "constant force among its types");
    report.duration = search.field(usage::duration, "duration");
    report.gain = search.optional(usage::gain);
    report.direction_enable = search.field(usage::direction_enable, "direction enable");
    report.direction = search.field_inside(usage::direction, "direction");
    report.place = search.place();
    return report;
}

void find_playing(Search& search, ForceLayout& layout)
{
    search.in(ReportKind::output, usage::set_constant_force_report, "Set Constant Force report");
    layout.set_constant_force.block = search.field(usage::effect_block_index, "effect block index");
    layout.set_constant_force.magnitude = search.field(usage::magnitude, "magnitude");
    layout.set_constant_force.place = search.place();

    search.in(ReportKind::output, usage::effect_operation_report, "Effect Operation report");
    layout.operation.block = search.field(usage::effect_block_index, "effect block index");
    layout.operation.operation =
        search.selector({usage::effect_start, usage::effect_stop}, "start and stop");
    layout.operation.loop_count = search.optional(usage::loop_count);
    layout.operation.place = search.place();

    search.anywhere(ReportKind::output, "Device Control report");
    layout.control.control = search.selector({usage::enable_actuators, usage::disable_actuators,
                                              usage::stop_all_effects, usage::device_reset},
                                             "enable, disable, stop and reset");
    layout.control.place = search.place();

    search.anywhere(ReportKind::output, "Device Gain report");
    if (const auto gain = search.optional(usage::device_gain)) {
        layout.device_gain = ForceLayout::DeviceGain{search.place(), *gain};
    }
    search.in(ReportKind::output, usage::block_free_report, "Block Free report");
    if (const auto block = search.optional(usage::effect_block_index)) {
        layout.block_free = ForceLayout::BlockFree{search.place(), *block};
    }
}

void find_loading(Search& search, ForceLayout& layout)
{
    search.in(ReportKind::feature, usage::create_new_effect_report, "Create New Effect report");
    layout.create.type = search.selector({usage::constant_force}, "constant force");
    layout.create.place = search.place();

    search.in(ReportKind::feature, usage::block_load_report, "Block Load report");
    layout.block_load.block = search.field(usage::effect_block_index, "effect block index");
    layout.block_load.status =
        search.selector({usage::load_success, usage::load_full}, "success and full");
    layout.block_load.place = search.place();
}

bool plays_on(const Descriptor& descriptor, Usage axis)
{
    return std::any_of(descriptor.fields.begin(), descriptor.fields.end(), [&](const Field& field) {
        return lies_in(field, usage::set_effect_report) && lies_in(field, usage::axes_enable) &&
               (is_variable_of(field, axis) || value_of(field, axis).has_value());
    });
}

} // namespace

bool is_force_device(const Descriptor& descriptor)
{
    const auto& all = descriptor.collections;
    return std::find(all.begin(), all.end(), usage::set_effect_report) != all.end();
}

base::Result<InputLayout> find_input(const Descriptor& descriptor)
{
    Search search{descriptor};
    search.anywhere(ReportKind::input, "input report");
    InputLayout layout;
    layout.axes.push_back(search.field(usage::x, "axis X"));
    if (!search.missing().empty()) return base::fail(search.missing());
    auto y = search.optional(usage::y);
    if (y && plays_on(descriptor, usage::y)) layout.axes.push_back(*std::move(y));
    for (const Field& axis : layout.axes) {
        if (axis.logical_min == axis.logical_max) return base::fail("an axis of it has no range");
    }
    for (Usage button = 0; button < buttons_max; ++button) {
        auto field = search.optional(usage::button_1 + button);
        if (!field) break;
        layout.buttons.push_back(*std::move(field));
    }
    layout.place = search.place();
    return layout;
}

base::Result<ForceLayout> find_force(const Descriptor& descriptor)
{
    Search search{descriptor};
    ForceLayout layout;
    layout.set_effect = find_set_effect(search);
    find_playing(search, layout);
    find_loading(search, layout);
    if (!search.missing().empty()) return base::fail(search.missing());
    if (layout.set_constant_force.magnitude.logical_min >= 0) {
        return base::fail("its constant forces have no sign");
    }
    return layout;
}

} // namespace hapnet::device::hid
