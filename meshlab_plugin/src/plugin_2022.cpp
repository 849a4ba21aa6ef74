// SPDX-License-Identifier: MIT OR Apache-2.0
#include "plugin_2022.h"

#include "filters.h"

using namespace fairmesh_meshlab;

FairmeshPlugin::FairmeshPlugin() {
    for (int filter : FILTERS) {
        typeList.push_back(filter);
        actionList.push_back(new QAction(filterName(filter), this));
    }
}

QString FairmeshPlugin::pluginName() const { return "FilterFairmesh"; }
QString FairmeshPlugin::vendor() const { return "fairmesh"; }
QString FairmeshPlugin::filterName(ActionIDType filter) const { return name(filter); }
QString FairmeshPlugin::pythonFilterName(ActionIDType filter) const { return python_name(filter); }
QString FairmeshPlugin::filterInfo(ActionIDType filter) const { return help(filter); }
FilterPlugin::FilterClass FairmeshPlugin::getClass(const QAction *action) const { return static_cast<FilterClass>(menus(ID(action))); }
int FairmeshPlugin::getPreConditions(const QAction *action) const { return needs(ID(action)); }
int FairmeshPlugin::postCondition(const QAction *action) const { return changes(ID(action)); }

RichParameterList FairmeshPlugin::initParameterList(const QAction *action, const MeshDocument &) { return parameters(ID(action)); }

std::map<std::string, QVariant> FairmeshPlugin::applyFilter(const QAction *action, const RichParameterList &asked, MeshDocument &document,
                                                            unsigned int &changed, vcg::CallBackPos *progress) {
    const Host host = {progress, [this](const std::string &line) { log(GLLogStream::FILTER, line); },
                       [this](const std::string &line) { log(GLLogStream::WARNING, line); }};
    QString error;
    try {
        changed = static_cast<unsigned int>(changes(ID(action)));
        return apply(ID(action), document.mm(), asked, host);
    } catch (const std::exception &why) {
        error = QString::fromUtf8(why.what());
    } catch (...) {
        error = "An unknown error.";
    }
    throw MLException(error);
}
