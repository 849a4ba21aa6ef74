// SPDX-License-Identifier: MIT OR Apache-2.0
/** What no host can be made to do from outside: its progress bar asks the filter to stop, and the log is null. The filters run on a mesh of
 *  MeshLab's own library, without the program. Ends with 0 if all is well. */
#include "../src/filters.h"

#include <vcg/complex/algorithms/create/platonic.h>
#include <vcg/complex/algorithms/update/bounding.h>
#include <vcg/complex/algorithms/update/normal.h>

#include <QApplication>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <vector>

using namespace fairmesh_meshlab;

namespace {

int calls = 0;
int stop_at = 0;
bool tell(const int, const char *) { return ++calls != stop_at; }

int failures = 0;
void check(bool good, const char *what) {
    if (good) return;
    std::printf("cancel.cpp: %s\n", what);
    ++failures;
}

/** All coordinates, normals and qualities, and the sizes. */
std::vector<double> state(const CMeshO &mesh) {
    std::vector<double> all = {double(mesh.vert.size()), double(mesh.face.size()), double(mesh.vn), double(mesh.fn)};
    for (const CVertexO &v : mesh.vert) {
        for (int k = 0; k < 3; ++k) {
            all.push_back(v.cP()[k]);
            all.push_back(v.cN()[k]);
        }
        all.push_back(v.cQ());
    }
    for (const CFaceO &f : mesh.face) all.push_back(f.IsS());
    return all;
}

/** A sphere with its upper part selected and dented, and a hole below. */
void make(MeshModel &model) {
    CMeshO &mesh = model.cm;
    vcg::tri::Sphere(mesh, 4);
    for (CFaceO &face : mesh.face) {
        const Scalar height = (face.cP(0) + face.cP(1) + face.cP(2))[2] / 3;
        if (height > Scalar(0.5)) face.SetS();
        if (height < Scalar(-0.9)) vcg::tri::Allocator<CMeshO>::DeleteFace(mesh, face);
    }
    for (CVertexO &vertex : mesh.vert)
        if (vertex.cP()[2] > Scalar(0.7)) vertex.P() *= Scalar(0.9);
    vcg::tri::UpdateBounding<CMeshO>::Box(mesh);
    vcg::tri::UpdateNormal<CMeshO>::PerFaceNormalized(mesh);
    vcg::tri::UpdateNormal<CMeshO>::PerVertexAngleWeighted(mesh);
}

double worst(const CMeshO &mesh) {
    double most = 0;
    for (const CVertexO &vertex : mesh.vert)
        if (!vertex.IsD() && vertex.cP()[2] > Scalar(-0.5)) most = std::max(most, std::abs(double(vertex.cP().Norm()) - 1));
    return most;
}

/** Stops a filter at its first, second, ... word, until it runs to its end. */
void cancel_everywhere(int filter) {
    MeshDocument document;
    MeshModel *model = document.addNewMesh("", "sphere");
    make(*model);
    const auto before = state(model->cm);
    const auto print = [](const std::string &line) { std::printf("  %s\n", line.c_str()); };
    const Host host = {tell, print, print};
    int cancelled = 0;
    for (stop_at = 1; stop_at < 1000; ++stop_at) {
        calls = 0;
        try {
            apply(filter, model, parameters(filter), host);
            break;
        } catch (const Failure &why) {
            ++cancelled;
            check(!std::strncmp(why.what(), "Cancelled", 9), why.what());
            check(calls == stop_at, "the filter went on after it was stopped");
            check(state(model->cm) == before, "the mesh has changed although the filter was stopped");
        }
    }
    check(cancelled > 3, "the filter tells of its progress too seldom");
    check(state(model->cm) != before, "the filter has done nothing");
    if (filter == FairSelection) check(worst(model->cm) < 1e-5, "the surface is not the sphere");
    std::printf("cancel.cpp: filter %d stopped at %d places, then applied\n", filter, cancelled);
}

} // namespace

int main(int count, char **words) {
    QCoreApplication application(count, words);
    cancel_everywhere(FairSelection);
    cancel_everywhere(CloseHoles);
    return failures > 0;
}
