// A hole in a sphere's cap is filled, so that the cap looks as if it had never been there.
#include <cmath>
#include <cstdio>
#include <fairmesh.hpp>

int main() {
    constexpr std::uint32_t side = 21;
    std::vector<std::array<double, 3>> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::uint32_t j = 0; j < side; j++) {
        for (std::uint32_t i = 0; i < side; i++) {
            double x = 0.06 * i - 0.6, y = 0.06 * j - 0.6;
            positions.push_back({x, y, std::sqrt(1.0 - x * x - y * y)});
            bool hole = i > 5 && i < 14 && j > 5 && j < 14;
            if (i + 1 == side || j + 1 == side || hole) continue;
            std::uint32_t v = j * side + i;
            triangles.push_back({v, v + 1, v + side + 1});
            triangles.push_back({v, v + side + 1, v + side});
        }
    }
    try {
        fairmesh::options options;
        options.on_progress = [](const fairmesh_progress &p) { return p.fraction <= 1.0; };
        auto filled = fairmesh::fill_holes(fairmesh::mesh(positions, triangles), {}, options);
        double worst = 0.0;
        for (auto &p : filled.positions()) {
            worst = std::fmax(worst, std::fabs(std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) - 1.0));
        }
        std::printf("%u new vertices, at most %.1e off the sphere\n", static_cast<unsigned>(filled.info().new_vertex_count), worst);
        return filled.info().new_vertex_count > 20 && worst < 1e-3 ? 0 : 2;
    } catch (const fairmesh::error &e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 1;
    }
}
