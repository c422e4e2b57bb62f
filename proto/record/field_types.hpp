// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/bytes.hpp"
#include "proto/record/rows.hpp"

namespace hapnet::record {

/// The encoding of a field of type T in a row: the type and unit in the header, the number of
/// bytes, and the functions put() and take(). take() returns false if put() does not write such
/// bytes.
template <typename T>
struct FieldType;

template <>
struct FieldType<std::uint8_t> {
    static constexpr std::string_view type = "u8", unit = "";
    static constexpr std::size_t bytes = 1;
    static void put(base::ByteWriter& out, std::uint8_t value) { out.u8(value); }
    static bool take(base::ByteReader& in, std::uint8_t& value)
    {
        value = in.u8();
        return true;
    }
};

template <>
struct FieldType<std::uint16_t> {
    static constexpr std::string_view type = "u16", unit = "";
    static constexpr std::size_t bytes = 2;
    static void put(base::ByteWriter& out, std::uint16_t value) { out.u16(value); }
    static bool take(base::ByteReader& in, std::uint16_t& value)
    {
        value = in.u16();
        return true;
    }
};

template <>
struct FieldType<std::uint32_t> {
    static constexpr std::string_view type = "u32", unit = "";
    static constexpr std::size_t bytes = 4;
    static void put(base::ByteWriter& out, std::uint32_t value) { out.u32(value); }
    static bool take(base::ByteReader& in, std::uint32_t& value)
    {
        value = in.u32();
        return true;
    }
};

template <>
struct FieldType<std::uint64_t> {
    static constexpr std::string_view type = "u64", unit = "";
    static constexpr std::size_t bytes = 8;
    static void put(base::ByteWriter& out, std::uint64_t value) { out.u64(value); }
    static bool take(base::ByteReader& in, std::uint64_t& value)
    {
        value = in.u64();
        return true;
    }
};

template <>
struct FieldType<bool> {
    static constexpr std::string_view type = "bool", unit = "";
    static constexpr std::size_t bytes = 1;
    static void put(base::ByteWriter& out, bool value) { out.u8(value ? 1 : 0); }
    static bool take(base::ByteReader& in, bool& value)
    {
        const std::uint8_t byte = in.u8();
        value = byte == 1;
        return byte <= 1;
    }
};

template <>
struct FieldType<Phase> {
    static constexpr std::string_view type = "u8", unit = "";
    static constexpr std::size_t bytes = 1;
    static void put(base::ByteWriter& out, Phase value)
    {
        out.u8(static_cast<std::uint8_t>(value));
    }
    static bool take(base::ByteReader& in, Phase& value)
    {
        const std::uint8_t byte = in.u8();
        if (byte >= base::names_of_enum<Phase>.size()) return false;
        value = static_cast<Phase>(byte);
        return true;
    }
};

/// The largest time in a record, about 36 years, which no clock and no session of this project
/// exceeds. It ensures that sums of several times cannot overflow in a reader of a damaged record.
inline constexpr base::Duration time_max{std::int64_t{1} << 60};

template <>
struct FieldType<base::Duration> {
    static constexpr std::string_view type = "i64", unit = "ns";
    static constexpr std::size_t bytes = 8;
    static void put(base::ByteWriter& out, base::Duration value) { out.i64(value.count()); }
    static bool take(base::ByteReader& in, base::Duration& value)
    {
        value = base::Duration{in.i64()};
        return -time_max <= value && value <= time_max;
    }
};

template <>
struct FieldType<base::TimePoint> {
    static constexpr std::string_view type = "i64", unit = "ns of CLOCK_BOOTTIME";
    static constexpr std::size_t bytes = 8;
    static void put(base::ByteWriter& out, base::TimePoint value)
    {
        FieldType<base::Duration>::put(out, value.time_since_epoch());
    }
    static bool take(base::ByteReader& in, base::TimePoint& value)
    {
        base::Duration since_epoch{};
        const bool sane = FieldType<base::Duration>::take(in, since_epoch);
        value = base::TimePoint{since_epoch};
        return sane;
    }
};

/// Three doubles with the same physical unit. Values that are not finite are accepted, because a
/// record must also document a run that went wrong.
template <typename V>
struct VectorFieldType {
    static constexpr std::string_view type = "f64[3]";
    static constexpr std::size_t bytes = 24;
    static void put(base::ByteWriter& out, const V& vector)
    {
        out.f64(vector.value.x);
        out.f64(vector.value.y);
        out.f64(vector.value.z);
    }
    static bool take(base::ByteReader& in, V& vector)
    {
        vector.value.x = in.f64();
        vector.value.y = in.f64();
        vector.value.z = in.f64();
        return true;
    }
};

template <>
struct FieldType<base::Position> : VectorFieldType<base::Position> {
    static constexpr std::string_view unit = "m";
};
template <>
struct FieldType<base::Velocity> : VectorFieldType<base::Velocity> {
    static constexpr std::string_view unit = "m/s";
};
template <>
struct FieldType<base::Force> : VectorFieldType<base::Force> {
    static constexpr std::string_view unit = "N";
};

template <>
struct FieldType<AngularVelocity> : VectorFieldType<AngularVelocity> {
    static constexpr std::string_view unit = "rad/s";
};

/// A quaternion: w, x, y, z.
template <>
struct FieldType<glm::dquat> {
    static constexpr std::string_view type = "f64[4]", unit = "";
    static constexpr std::size_t bytes = 32;
    static void put(base::ByteWriter& out, const glm::dquat& value)
    {
        for (const double part : {value.w, value.x, value.y, value.z}) out.f64(part);
    }
    static bool take(base::ByteReader& in, glm::dquat& value)
    {
        for (double* part : {&value.w, &value.x, &value.y, &value.z}) *part = in.f64();
        return true;
    }
};

template <>
struct FieldType<double> {
    static constexpr std::string_view type = "f64", unit = "";
    static constexpr std::size_t bytes = 8;
    static void put(base::ByteWriter& out, double value) { out.f64(value); }
    static bool take(base::ByteReader& in, double& value)
    {
        value = in.f64();
        return true;
    }
};

/// A length, followed by as many bytes.
template <>
struct FieldType<std::vector<std::byte>> {
    static constexpr std::string_view type = "u16 n, u8[n]", unit = "";
    static constexpr std::size_t bytes = 2; // smallest size: the length alone
    static void put(base::ByteWriter& out, const std::vector<std::byte>& value)
    {
        out.u16(static_cast<std::uint16_t>(value.size()));
        out.raw(value);
    }
    static bool take(base::ByteReader& in, std::vector<std::byte>& value)
    {
        const auto taken = in.raw(in.u16());
        value.assign(taken.begin(), taken.end());
        return in.ok();
    }
};

} // namespace hapnet::record
