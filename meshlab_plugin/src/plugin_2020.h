// SPDX-License-Identifier: MIT OR Apache-2.0
/** The filters as a plugin of MeshLab 2020.09. Nothing is thrown into the host: it would abort. */
#ifndef FAIRMESH_MESHLAB_PLUGIN_2020_H
#define FAIRMESH_MESHLAB_PLUGIN_2020_H

#include "host.h"

class FairmeshPlugin : public QObject, public MeshFilterInterface {
    Q_OBJECT
    Q_PLUGIN_METADATA(IID MESH_FILTER_INTERFACE_IID)
    Q_INTERFACES(MeshFilterInterface)

  public:
    FairmeshPlugin();

    QString pluginName() const override;
    QString filterName(FilterIDType filter) const override;
    QString filterInfo(FilterIDType filter) const override;
    FilterClass getClass(QAction *action) override;
    FILTER_ARITY filterArity(QAction *) const override { return SINGLE_MESH; }
    int getPreConditions(QAction *action) const override;
    int postCondition(QAction *action) const override;
    // Not the variant with a mesh: the document may have none.
    void initParameterSet(QAction *action, MeshDocument &document, RichParameterList &list) override;
    bool applyFilter(QAction *action, MeshDocument &document, const RichParameterList &asked, vcg::CallBackPos *progress) override;
};

#endif
