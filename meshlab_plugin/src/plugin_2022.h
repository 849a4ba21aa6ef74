// SPDX-License-Identifier: MIT OR Apache-2.0
/** The filters as a plugin of MeshLab and PyMeshLab 2022.02 and later. The only exception thrown is the host's own. */
#ifndef FAIRMESH_MESHLAB_PLUGIN_2022_H
#define FAIRMESH_MESHLAB_PLUGIN_2022_H

#include "host.h"

class FairmeshPlugin : public QObject, public FilterPlugin {
    Q_OBJECT
    MESHLAB_PLUGIN_IID_EXPORTER(FILTER_PLUGIN_IID)
    Q_INTERFACES(FilterPlugin)

  public:
    FairmeshPlugin();

    QString pluginName() const override;
    QString vendor() const override;
    QString filterName(ActionIDType filter) const override;
    QString pythonFilterName(ActionIDType filter) const override;
    QString filterInfo(ActionIDType filter) const override;
    FilterClass getClass(const QAction *action) const override;
    FilterArity filterArity(const QAction *) const override { return SINGLE_MESH; }
    int getPreConditions(const QAction *action) const override;
    int postCondition(const QAction *action) const override;
    // Not the variant with a mesh: the document may have none.
    RichParameterList initParameterList(const QAction *action, const MeshDocument &document) override;
    std::map<std::string, QVariant> applyFilter(const QAction *action, const RichParameterList &asked, MeshDocument &document,
                                                unsigned int &changed, vcg::CallBackPos *progress) override;
};

#endif
