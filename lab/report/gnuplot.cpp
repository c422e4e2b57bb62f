// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/gnuplot.hpp"

#include "lab/report/words.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::report {

namespace {

/// A name from a file as gnuplot may read it: nothing in it ends a text or runs a command.
std::string harmless(std::string_view name)
{
    std::string out;
    for (const char c : name) {
        const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                              (c >= '0' && c <= '9') || c == '-' || c == '.';
        out += is_plain ? c : '-';
    }
    return out.empty() ? "-" : out;
}

std::string cell(std::optional<double> value)
{
    return value ? fmt::format("{:.6g}", *value) : "NaN";
}

/// What every script begins with; the height is in cm. Colours after Okabe and Ito.
std::string preamble(std::string_view name, int height_cm)
{
    return fmt::format("# In this folder: gnuplot {0}.gp writes {0}.pdf;\n"
                       "# gnuplot -e \"format='svg'\" {0}.gp writes {0}.svg.\n"
                       "if (!exists(\"format\")) format = 'pdf'\n"
                       "if (format eq 'svg') {{\n"
                       "    set terminal svg size 900,{1} noenhanced\n"
                       "}} else {{\n"
                       "    set terminal pdfcairo size 18cm,{2}cm noenhanced font ',8'\n"
                       "}}\n"
                       "set output '{0}.'.format\n"
                       "set linetype 1 linecolor rgb '#0072b2'\n"
                       "set linetype 2 linecolor rgb '#d98200'\n"
                       "set key above\n"
                       "set grid ytics\n",
                       name, 50 * height_cm, height_cm);
}

std::string histogram_preamble(std::string_view name)
{
    return preamble(name, 8) + "set style data histograms\n"
                               "set style histogram clustered gap 1\n"
                               "set style fill solid 0.7 border -1\n"
                               "set yrange [0:*]\n"
                               "set offsets 0, 0, graph 0.12, 0\n"
                               "set xtics rotate by -20\n";
}

void add_table1(const Results& results, std::vector<File>& files)
{
    if (results.table1.empty()) return;
    std::string data = "# mm: algorithm, paper and measured of mean, std, max\n";
    for (const Table1Row& row : results.table1) {
        data += fmt::format("{} {} {} {} {} {} {}\n", harmless(row.algorithm),
                            cell(row.paper_mean_mm), cell(row.mean_mm), cell(row.paper_std_mm),
                            cell(row.std_mm), cell(row.paper_max_mm), cell(row.max_mm));
    }
    std::string script = histogram_preamble("table1") + "set multiplot layout 1,3\n"
                                                        "set ylabel 'mm'\n";
    int column = 2;
    for (const std::string_view quantity : {"mean", "std", "max"}) {
        script += fmt::format("set title 'x discrepancy, {}'\n"
                              "plot 'table1.dat' using {}:xtic(1) title 'paper', "
                              "'' using {} title 'measured'\n",
                              quantity, column, column + 1);
        column += 2;
    }
    script += "unset multiplot\n";
    files.push_back({"gnuplot/table1.dat", std::move(data)});
    files.push_back({"gnuplot/table1.gp", std::move(script)});
}

/// The worst of the tasks: one block of data and one plot for each impairment.
void add_limits(const Results& results, std::string_view name,
                const std::vector<std::string_view>& impairments, std::vector<File>& files)
{
    std::string data = "# algorithm, paper, measured; 1 where it never failed\n", plots;
    int index = 0;
    for (const std::string_view impairment : impairments) {
        std::string block, unit;
        for (const LimitRow& row : results.limits) {
            if (row.impairment != impairment || row.task != worst_task) continue;
            block += fmt::format("{} {} {} {}\n", harmless(row.algorithm), cell(row.paper_limit),
                                 cell(row.limit), row.is_open() ? 1 : 0);
            unit = unit_text(row.unit);
        }
        if (block.empty()) continue;
        data += block + "\n\n";
        plots += fmt::format("set title '{0}'\nset ylabel '{1}'\n"
                             "plot '{2}.dat' index {3} using 2:xtic(1) title 'paper', "
                             "'' index {3} using 3 title 'measured', "
                             "'' index {3} using 0:3:($4 > 0 ? '>' : '') with labels "
                             "offset 1,0.7 notitle\n",
                             impairment_text(impairment), unit == "%" ? unit : harmless(unit), name,
                             index++);
    }
    if (index == 0) return;
    files.push_back({fmt::format("gnuplot/{}.dat", name), std::move(data)});
    files.push_back({fmt::format("gnuplot/{}.gp", name),
                     histogram_preamble(name) + fmt::format("set multiplot layout 1,{}\n", index) +
                         plots + "unset multiplot\n"});
}

void add_fig7(const Results& results, std::vector<File>& files)
{
    if (results.trajectories.empty()) return;
    std::string data = "# s, cube at L and at R in mm; one block for each algorithm\n", plots;
    int index = 0;
    for (const auto& name :
         distinct(results.trajectories, [](const auto& r) { return r.algorithm; })) {
        for (const TrajectoryRow& row : results.trajectories) {
            if (row.algorithm != name) continue;
            data += fmt::format("{} {} {}\n", cell(row.time_s), cell(row.cube_l_mm),
                                cell(row.cube_r_mm));
        }
        data += "\n\n";
        plots +=
            fmt::format("set title '{0}'\n"
                        "plot 'fig7.dat' index {1} using 1:3 with lines linetype 2 title 'cube "
                        "at R', '' index {1} using 1:2 with lines linetype 1 title 'cube at "
                        "L'\n",
                        harmless(name), index++);
    }
    files.push_back({"gnuplot/fig7.dat", std::move(data)});
    files.push_back(
        {"gnuplot/fig7.gp", preamble("fig7", 5 * index) +
                                fmt::format("set multiplot layout {},1\n", index) +
                                "set xlabel 's'\nset xrange [*:*] noextend\nset ylabel 'x, mm'\n" +
                                plots + "unset multiplot\n"});
}

} // namespace

std::vector<File> gnuplot_files(const Results& results)
{
    std::vector<File> files;
    add_table1(results, files);
    add_limits(results, "fig6a", {"delay", "jitter"}, files);
    add_limits(results, "fig6b", {"random-loss", "burst-loss"}, files);
    add_fig7(results, files);
    return files;
}

} // namespace hapnet::lab::report
