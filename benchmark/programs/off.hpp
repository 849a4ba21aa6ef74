// What the C++ programs of this folder read and write: NAME INPUT.off fill|fair NUMBERS OUTPUT.off WORD..., where NUMBERS is a file with
// the vertices of the hole, or the free ones. They end with 0 for a success, and with 1 and a reason on stderr where there is no result.
#pragma once

#include <array>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

struct Off {
    std::vector<std::array<double, 3>> points;
    std::vector<std::array<unsigned, 3>> faces;
};

inline Off read_off(const char *path) {
    std::ifstream in(path);
    std::string word;
    std::size_t points = 0, faces = 0;
    in >> word >> points >> faces >> word;
    Off off{std::vector<std::array<double, 3>>(points), std::vector<std::array<unsigned, 3>>(faces)};
    for (auto &point : off.points) in >> point[0] >> point[1] >> point[2];
    for (auto &face : off.faces) in >> word >> face[0] >> face[1] >> face[2];
    return off;
}

inline void write_off(const Off &off, const char *path) {
    std::ofstream out(path);
    out.precision(17);
    out << "OFF\n" << off.points.size() << ' ' << off.faces.size() << " 0\n";
    for (auto &point : off.points) out << point[0] << ' ' << point[1] << ' ' << point[2] << '\n';
    for (auto &face : off.faces) out << "3 " << face[0] << ' ' << face[1] << ' ' << face[2] << '\n';
}

inline std::set<unsigned> read_numbers(const char *path) {
    std::ifstream in(path);
    return {std::istream_iterator<unsigned>(in), {}};
}
