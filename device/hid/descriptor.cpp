// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hid/descriptor.hpp"

#include "device/hid/descriptor_items.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::device::hid {

namespace {

// Limits far above those of any device: a report has no more bytes than the kernel's buffer, and
// collections and pushes nest at most one level deeper than in existing descriptors.
constexpr std::uint32_t report_bits_max = 8 * 4096;
constexpr std::size_t fields_max = 2048;
constexpr std::size_t collections_max = 16;
constexpr std::size_t pushes_max = 4;
constexpr std::size_t ranges_max = 256;

constexpr std::uint32_t value_bits_max = 32;
constexpr std::uint32_t is_constant = 0x01; // bit of a main item's flags
constexpr std::uint32_t is_variable = 0x02;

/// Global items, which are in effect until they change.
struct Globals {
    std::uint16_t usage_page = 0;
    ItemValue logical_min{};
    ItemValue logical_max{};
    ItemValue physical_min{};
    ItemValue physical_max{};
    std::uint32_t unit = 0;
    int unit_exponent = 0;
    std::uint32_t report_size = 0;
    std::uint32_t report_count = 0;
    std::uint8_t report_id = 0;
};

/// A usage as an item states it. If it has no page, the page of the main item applies.
struct LocalUsage {
    std::uint32_t value = 0;
    bool has_page = false;
};

/// Local items, which are in effect for the next main item only.
struct Locals {
    std::vector<std::pair<LocalUsage, LocalUsage>> usages{};
    std::optional<LocalUsage> range_from{};
};

Usage complete(LocalUsage usage, std::uint16_t page)
{
    if (usage.has_page) return usage.value;
    return (static_cast<Usage>(page) << 16U) | usage.value;
}

/// Returns the lower and the upper end. The upper one is read as unsigned if the lower one is not
/// negative, because many devices write 255 in one byte.
std::pair<std::int64_t, std::int64_t> range(const ItemValue& low, const ItemValue& high)
{
    const std::int64_t from = low.as_signed;
    return {from, from >= 0 && high.as_signed < 0 ? high.as_unsigned : high.as_signed};
}

class Parser {
public:
    base::Result<Descriptor> parse(std::span<const std::byte> bytes);

private:
    // Each returns what is wrong with the item, or "".
    std::string on_item(const Item& item);
    std::string on_main(const Item& item);
    std::string on_global(const Item& item);
    std::string on_local(const Item& item);
    std::string on_report_id(std::uint32_t id);
    std::string on_usage_range_end(LocalUsage last);
    std::string open_collection();
    std::string add_fields(ReportKind kind, std::uint32_t flags);

    [[nodiscard]] std::vector<UsageRange> usages() const;
    [[nodiscard]] Field field_of(ReportKind kind, std::uint32_t flags) const;
    ReportSize& report(ReportKind kind);

    Descriptor descriptor_;
    Globals globals_;
    std::vector<Globals> pushed_;
    Locals locals_;
    std::vector<Usage> open_;
};

base::Result<Descriptor> Parser::parse(std::span<const std::byte> bytes)
{
    if (bytes.size() > descriptor_bytes_max) return base::fail("longer than 4096 bytes");
    ItemReader reader{bytes};
    while (const auto item = reader.next()) {
        if (const std::string wrong = on_item(*item); !wrong.empty()) {
            return base::fail(fmt::format("byte {}: {}", item->at, wrong));
        }
    }
    if (!reader.is_complete()) return base::fail("cut off in the middle of an item");
    if (!open_.empty()) return base::fail("a collection does not end");
    const bool mixes = std::any_of(
        descriptor_.reports.begin(), descriptor_.reports.end(),
        [&](const ReportSize& one) { return descriptor_.is_numbered && one.report_id == 0; });
    if (mixes) return base::fail("some reports have a number and some have none");
    return std::move(descriptor_);
}

std::string Parser::on_item(const Item& item)
{
    switch (item.type) {
    case ItemType::main: {
        std::string wrong = on_main(item);
        locals_ = {};
        return wrong;
    }
    case ItemType::global: return on_global(item);
    case ItemType::local: return on_local(item);
    case ItemType::long_item: return ""; // no long item has ever been defined
    case ItemType::reserved: break;
    }
    return "an item of a reserved type";
}

std::string Parser::on_main(const Item& item)
{
    const auto flags = static_cast<std::uint32_t>(item.value.as_unsigned);
    switch (item.tag) {
    case 0x8: return add_fields(ReportKind::input, flags);
    case 0x9: return add_fields(ReportKind::output, flags);
    case 0xb: return add_fields(ReportKind::feature, flags);
    case 0xa: return open_collection();
    case 0xc:
        if (open_.empty()) return "the end of a collection that never began";
        open_.pop_back();
        return "";
    default: return "an unknown main item";
    }
}

std::string Parser::on_global(const Item& item)
{
    const auto value = static_cast<std::uint32_t>(item.value.as_unsigned);
    switch (item.tag) {
    case 0x0:
        if (value > 0xffff) return "a usage page above 0xffff";
        globals_.usage_page = static_cast<std::uint16_t>(value);
        return "";
    case 0x1: globals_.logical_min = item.value; return "";
    case 0x2: globals_.logical_max = item.value; return "";
    case 0x3: globals_.physical_min = item.value; return "";
    case 0x4: globals_.physical_max = item.value; return "";
    case 0x5: // a signed nibble; some devices write -3 as a byte
        globals_.unit_exponent = static_cast<int>(value & 0xfU);
        if (globals_.unit_exponent > 7) globals_.unit_exponent -= 16;
        return "";
    case 0x6: globals_.unit = value; return "";
    case 0x7:
        if (value > report_bits_max) return "a value of too many bits";
        globals_.report_size = value;
        return "";
    case 0x8: return on_report_id(value);
    case 0x9:
        if (value > report_bits_max) return "too many values";
        globals_.report_count = value;
        return "";
    case 0xa:
        if (pushed_.size() == pushes_max) return "pushed too often";
        pushed_.push_back(globals_);
        return "";
    case 0xb:
        if (pushed_.empty()) return "popped more than was pushed";
        globals_ = pushed_.back();
        pushed_.pop_back();
        return "";
    default: return "an unknown global item";
    }
}

std::string Parser::on_report_id(std::uint32_t id)
{
    if (id == 0 || id > 0xff) return "a report ID is not within 1 to 255";
    globals_.report_id = static_cast<std::uint8_t>(id);
    descriptor_.is_numbered = true;
    return "";
}

std::string Parser::on_local(const Item& item)
{
    const LocalUsage usage{static_cast<std::uint32_t>(item.value.as_unsigned), item.size == 4};
    switch (item.tag) {
    case 0x0:
        if (locals_.usages.size() == ranges_max) return "too many usages";
        locals_.usages.emplace_back(usage, usage);
        return "";
    case 0x1: locals_.range_from = usage; return "";
    case 0x2: return on_usage_range_end(usage);
    case 0xa: return "delimiters are not understood";
    default: return ""; // designators and strings do not affect the form of a report
    }
}

std::string Parser::on_usage_range_end(LocalUsage last)
{
    if (!locals_.range_from) return "a range of usages ends that never began";
    const LocalUsage first = *std::exchange(locals_.range_from, std::nullopt);
    if (first.has_page != last.has_page || first.value > last.value) {
        return "a range of usages runs backwards";
    }
    if (locals_.usages.size() == ranges_max) return "too many usages";
    locals_.usages.emplace_back(first, last);
    return "";
}

std::string Parser::open_collection()
{
    if (open_.size() == collections_max) return "collections lie too deep";
    const std::vector<UsageRange> own = usages();
    open_.push_back(own.empty() ? 0 : own.front().first);
    auto& seen = descriptor_.collections;
    if (std::find(seen.begin(), seen.end(), open_.back()) == seen.end()) {
        seen.push_back(open_.back());
    }
    return "";
}

std::vector<UsageRange> Parser::usages() const
{
    std::vector<UsageRange> ranges;
    for (const auto& [first, last] : locals_.usages) {
        ranges.push_back(
            {complete(first, globals_.usage_page), complete(last, globals_.usage_page)});
    }
    return ranges;
}

ReportSize& Parser::report(ReportKind kind)
{
    auto& all = descriptor_.reports;
    const auto known = std::find_if(all.begin(), all.end(), [&](const ReportSize& one) {
        return one.kind == kind && one.report_id == globals_.report_id;
    });
    if (known != all.end()) return *known;
    return all.emplace_back(ReportSize{kind, globals_.report_id, 0});
}

Field Parser::field_of(ReportKind kind, std::uint32_t flags) const
{
    Field field{.kind = kind, .report_id = globals_.report_id, .bit_size = globals_.report_size};
    std::tie(field.logical_min, field.logical_max) =
        range(globals_.logical_min, globals_.logical_max);
    std::tie(field.physical_min, field.physical_max) =
        range(globals_.physical_min, globals_.physical_max);
    field.unit = globals_.unit;
    field.unit_exponent = globals_.unit_exponent;
    field.is_array = (flags & is_variable) == 0;
    field.collections = open_;
    return field;
}

std::string Parser::add_fields(ReportKind kind, std::uint32_t flags)
{
    ReportSize& size = report(kind);
    const std::uint64_t bits = std::uint64_t{globals_.report_size} * globals_.report_count;
    if (size.bits + bits > report_bits_max) return "a report is too long";
    const std::uint32_t begin = size.bits;
    size.bits += static_cast<std::uint32_t>(bits);
    if ((flags & is_constant) != 0 || bits == 0 || globals_.report_size > value_bits_max) return "";

    Field field = field_of(kind, flags);
    if (field.logical_min > field.logical_max) return "the logical range runs backwards";
    if (descriptor_.fields.size() + globals_.report_count > fields_max) return "too many values";
    const std::vector<UsageRange> ranges = usages();
    if (field.is_array) field.usages = ranges;
    std::size_t range_at = 0;
    std::uint32_t in_range = 0;
    for (std::uint32_t i = 0; i < globals_.report_count; ++i) {
        field.bit_offset = begin + i * globals_.report_size;
        if (!field.is_array && !ranges.empty()) {
            const Usage usage = ranges[range_at].first + in_range;
            field.usages = {{usage, usage}};
            if (usage < ranges[range_at].last) {
                ++in_range;
            } else if (range_at + 1 < ranges.size()) { // the last range applies to the rest
                ++range_at;
                in_range = 0;
            }
        }
        descriptor_.fields.push_back(field);
    }
    return "";
}

} // namespace

bool is_variable_of(const Field& field, Usage usage)
{
    return !field.is_array && !field.usages.empty() && field.usages.front().first == usage;
}

bool lies_in(const Field& field, Usage collection)
{
    return std::find(field.collections.begin(), field.collections.end(), collection) !=
           field.collections.end();
}

std::optional<std::int64_t> value_of(const Field& array, Usage usage)
{
    if (!array.is_array) return std::nullopt;
    std::int64_t value = array.logical_min;
    for (const UsageRange& range : array.usages) {
        if (usage >= range.first && usage <= range.last) {
            value += usage - range.first;
            if (value > array.logical_max) return std::nullopt;
            return value;
        }
        value += std::int64_t{range.last} - range.first + 1;
    }
    return std::nullopt;
}

std::size_t Descriptor::bytes_of(ReportKind kind, std::uint8_t report_id) const
{
    for (const ReportSize& report : reports) {
        if (report.kind == kind && report.report_id == report_id) return (report.bits + 7) / 8;
    }
    return 0;
}

base::Result<Descriptor> parse_descriptor(std::span<const std::byte> bytes)
{
    return Parser{}.parse(bytes);
}

} // namespace hapnet::device::hid
