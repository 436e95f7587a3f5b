// A clang-tidy module that keeps the checks to this project's own code: without it clang-tidy 14 walks through every
// system header for every check and throws away what it finds there, which is three quarters of its time.
#include <vector>

#include <clang-tidy/ClangTidyCheck.h>
#include <clang-tidy/ClangTidyModule.h>
#include <clang-tidy/ClangTidyModuleRegistry.h>
#include <clang/AST/ASTContext.h>
#include <clang/ASTMatchers/ASTMatchFinder.h>
#include <clang/Basic/SourceManager.h>

namespace gnomon::lint {

using clang::ast_matchers::MatchFinder;

/// Finds nothing. The translation unit is what all checks meet first, and its children are walked after that.
class OwnCodeOnly : public clang::tidy::ClangTidyCheck {
public:
    using ClangTidyCheck::ClangTidyCheck;

    void registerMatchers(MatchFinder* finder) override {
        finder->addMatcher(clang::ast_matchers::translationUnitDecl(), this);
    }

    void check(const MatchFinder::MatchResult& result) override {
        std::vector<clang::Decl*> own;
        for (clang::Decl* decl : result.Context->getTranslationUnitDecl()->decls())
            if (!result.SourceManager->isInSystemHeader(decl->getLocation())) own.push_back(decl);
        result.Context->setTraversalScope(own);
    }
};

class Module : public clang::tidy::ClangTidyModule {
public:
    void addCheckFactories(clang::tidy::ClangTidyCheckFactories& factories) override {
        factories.registerCheck<OwnCodeOnly>("gnomon-own-code-only");
    }
};

const clang::tidy::ClangTidyModuleRegistry::Add<Module> kRegistered("gnomon", "Checks this project's own code alone.");

} // namespace gnomon::lint
