// SPDX-License-Identifier: MIT OR Apache-2.0
#include "report.h"
#include "work.h"
#include "write.h"

#include <algorithm>
#include <cmath>

namespace fairmesh_meshlab {

Values mean_curvature(MeshModel &model, const MeshView &view, const Host &host) {
    std::vector<double> curvature = fairmesh::mean_curvature(view.mesh());
    double least = INFINITY, most = -INFINITY, sum = 0;
    std::size_t known = 0;
    for (std::size_t i = 0; i < curvature.size(); ++i) {
        double &h = curvature[i];
        if (std::isnan(h)) { // A vertex without faces. NaN would spoil the host's histograms.
            h = 0;
            continue;
        }
        least = std::min(least, h);
        most = std::max(most, h);
        sum += h;
        ++known;
    }
    const double mean = known > 0 ? sum / static_cast<double>(known) : 0;
    write_quality(model, curvature);
    host.log(text("Mean curvature %.6g to %.6g, on average %.6g, of %zu vertices", least, most, mean, known));
    return {{"curvature_min", least}, {"curvature_max", most}, {"curvature_mean", mean}, {"vertices", static_cast<int>(known)}};
}

} // namespace fairmesh_meshlab
