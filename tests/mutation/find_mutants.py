"""Finds what can be broken: a walk over clang's syntax tree that collects sites.

A site is an expression or a statement, with the texts that may stand in its place. Each of these is
a mutant. Its key names the function, what was changed into what and, from the second on, the how
manieth of that kind it is in that function; so a key outlives a change of lines, names of variables
and everything else that is said in the function.
"""

import re

from clang_tree import bare, callee, operator_name, type_of

BINARY = {
    "+": ["-"], "-": ["+"], "*": ["/"], "/": ["*"], "%": ["*"], "+=": ["-="], "-=": ["+="],
    "*=": ["/="], "/=": ["*="], "<": ["<=", ">="], "<=": ["<", ">"], ">": [">=", "<="],
    ">=": [">", "<"], "==": ["!="], "!=": ["=="],
}
INTEGER_ONLY = {"&": ["|"], "|": ["&"], "<<": [">>"], ">>": ["<<"]}
OTHER_CALL = {"min": "max", "max": "min", "fmin": "fmax", "fmax": "fmin"}
TAKEN_AWAY = {"sqrt", "abs", "fabs"}    # f(x) -> x
SYMMETRIC = {"dot", "min", "max", "fmin", "fmax"}
NOT_ARITHMETIC = re.compile(r"string|stream|char|vector<|iterator|auto")
SKIPPED = {"StaticAssertDecl", "TemplateArgument", "NonTypeTemplateParmDecl",
           "TemplateTypeParmDecl", "TemplateTemplateParmDecl", "UsingDecl", "FriendDecl"}
FUNCTIONS = {"FunctionDecl", "CXXMethodDecl", "CXXConstructorDecl", "CXXConversionDecl",
             "CXXDestructorDecl"}
EXPRESSION_STATEMENTS = {"BinaryOperator", "CompoundAssignOperator", "CXXOperatorCallExpr",
                         "CallExpr", "CXXMemberCallExpr", "ExprWithCleanups"}


class Mutant:
    """One fault: the text in the site's place, and the one where any type of operands must do.

    `key` is set by name_all(), `number` by schemata.number_all().
    """

    def __init__(self, site, function, label, text, any_type):
        self.site, self.function, self.label = site, function, label
        self.text, self.any_type = text, any_type
        self.key = self.number = None


class Site:
    """A stretch of a file and what may stand in its place.

    kind: "expression", "constant" (a literal), "statement" (without its semicolon) or "block".
    frozen: a constant expression, which can not be chosen when the program runs.
    """

    def __init__(self, path, source, begin, end, kind, frozen):
        self.path, self.source, self.begin, self.end = path, source, begin, end
        self.kind, self.frozen = kind, frozen
        self.mutants = []

    def original(self):
        return self.source[self.begin:self.end]

    def line(self):
        return self.source.count("\n", 0, self.begin) + 1

    def add(self, function, label, text, any_type=None):
        if text != self.original() and all(m.label != label for m in self.mutants):
            self.mutants.append(Mutant(self, function, label, text, any_type or text))


class Finder:
    """Collects the sites of given files from trees.

    sources: {path: text}. After visit() of all trees: sites, and softened, a set of
    (path, begin, end, text): where words give way that leave no choice when the program runs,
    `constexpr` of a floating-point constant and `[[noreturn]]`.
    """

    def __init__(self, sources):
        self.sources = sources
        self.by_span = {}
        self.softened = set()

    @property
    def sites(self):
        found = [site for site in self.by_span.values() if site.mutants]
        return sorted(found, key=lambda s: (s.path, s.begin, -s.end))

    def visit(self, tree):
        self._declaration(tree, (), False)

    # declarations

    def _declaration(self, node, scope, frozen):
        kind = node.get("kind", "")
        if kind in SKIPPED or node.get("isImplicit") or kind.endswith("Comment"):
            return
        name = node.get("name", "")
        children = node.get("inner", ())
        if kind == "NamespaceDecl":
            inner = scope if not scope and name == "eepa" else scope + (name,) * bool(name)
            for child in children:
                self._declaration(child, inner, False)
        elif kind == "FunctionTemplateDecl":
            # the first is the template, the others are what was made of it
            for child in [c for c in children if c.get("kind") in FUNCTIONS][:1]:
                self._declaration(child, scope, False)
        elif kind == "ClassTemplateDecl":
            for child in children:
                if child.get("kind") == "CXXRecordDecl":
                    self._declaration(child, scope, False)
        elif kind in ("CXXRecordDecl", "EnumDecl", "ClassTemplateSpecializationDecl"):
            for child in children:
                self._declaration(child, scope + (name,) * bool(name), False)
        elif kind in FUNCTIONS:
            for child in children:
                if child.get("kind") == "CXX11NoReturnAttr":
                    self._returns_after_all(child)
                self._any(child, scope + (name,), False, statement=False)
        elif kind in ("VarDecl", "FieldDecl", "EnumConstantDecl", "ParmVarDecl"):
            self._variable(node, scope + (name,), frozen, member=kind != "VarDecl")
        elif kind in ("VarTemplateDecl", "LinkageSpecDecl"):
            for child in children:
                self._declaration(child, scope, frozen)

    def _variable(self, node, scope, frozen, member=False):
        if node.get("constexpr"):
            frozen = not self._soften(node)
        for child in node.get("inner", ()):
            self._any(child, scope, frozen, statement=False)

    def _soften(self, node):
        """Turns constexpr of a floating-point constant into const; says whether it could."""
        span = node.get("span")
        if node.get("type", {}).get("qualType") not in ("const double", "const float") or \
                span is None or span.path not in self.sources:
            return False
        text = self.sources[span.path]
        found = re.search(r"\bconstexpr\b", text[span.begin:span.end])
        if not found:
            return False
        before = text[span.begin:span.begin + found.start()]
        inline = "" if "static" not in before else "inline "
        self.softened.add((span.path, span.begin + found.start(), span.begin + found.end(),
                           inline + "const"))
        return True

    def _returns_after_all(self, node):
        """Takes [[noreturn]] away: with it, the compiler knows that its body is not dropped."""
        span = node.get("span")
        if span and span.path in self.sources and self._text(node) == "noreturn":
            self.softened.add((span.path, span.begin, span.end, "maybe_unused"))

    # statements and expressions

    def _any(self, node, scope, frozen, statement):
        kind = node.get("kind")
        if kind is None or kind.endswith(("Type", "Comment", "Attr")) or kind in SKIPPED:
            return
        if statement and kind in EXPRESSION_STATEMENTS:
            self._drop(node, scope)
        if kind in ("CXXRecordDecl", "TypeAliasDecl", "TypedefDecl", "EnumDecl"):
            # a lambda's class repeats its body, which stands beside it too
            return
        if kind == "VarDecl":
            self._variable(node, scope, frozen)
            return
        if kind == "ConstantExpr":
            frozen = True
        children = node.get("inner", ())
        handler = getattr(self, "_on_" + kind, None)
        if handler:
            handler(node, children, scope, frozen)
        bodies = self._bodies(node, kind, children)
        for number, child in enumerate(children):
            if number != self._left_alone(node, kind):
                self._any(child, scope, frozen, statement=number in bodies)

    @staticmethod
    def _bodies(node, kind, children):
        """Which children are statements of their own."""
        if kind == "CompoundStmt":
            return range(len(children))
        if kind in ("ForStmt", "WhileStmt", "DoStmt", "CXXForRangeStmt", "DefaultStmt", "CaseStmt"):
            return {0 if kind == "DoStmt" else len(children) - 1}
        if kind == "IfStmt":
            first = 1 + bool(node.get("hasInit")) + bool(node.get("hasVar"))
            return set(range(first, len(children)))
        return ()

    @staticmethod
    def _left_alone(node, kind):
        """The child that the compiler evaluates, and for which a fault seldom compiles."""
        if kind == "CaseStmt":
            return 0
        if kind == "IfStmt" and node.get("isConstexpr"):
            return int(bool(node.get("hasInit")))
        return None

    def _site(self, node, frozen, kind="expression"):
        span = node.get("span")
        if span is None or span.path not in self.sources:
            return None
        text = self.sources[span.path]
        if text[span.end:span.end + 1] == "(" and kind in ("expression", "constant"):
            return None    # a macro with arguments
        at = (span.path, span.begin, span.end)
        if at not in self.by_span:
            self.by_span[at] = Site(span.path, text, span.begin, span.end, kind, frozen)
        site = self.by_span[at]
        if kind in ("statement", "block"):
            site.kind = kind
        site.frozen = site.frozen or frozen
        return site

    def _text(self, node):
        span = node["span"]
        return self.sources[span.path][span.begin:span.end]

    def _drop(self, node, scope):
        site = self._site(node, False, "statement")
        if not site or "=" not in site.original() and "(" not in site.original():
            return
        while node.get("kind") == "ExprWithCleanups":
            node = node["inner"][0]
        what = node.get("opcode") or operator_name(node)
        if node.get("kind") == "CXXThrowExpr":
            what = "throw"
        what = what or (callee(node) or "call") + "()"
        if what not in ("++", "--"):
            operands = [c for c in node.get("inner", ()) if "span" in c][-2:]
            left = f"eepa_mutant::as_it_was({self._text(operands[0])})" if what == "=" else None
            site.add("::".join(scope), f"{what} dropped", "", left)

    def _on_BinaryOperator(self, node, children, scope, frozen):
        self._binary(node, node["opcode"], children[0], children[1], scope, frozen)

    def _on_CompoundAssignOperator(self, node, children, scope, frozen):
        self._binary(node, node["opcode"], children[0], children[1], scope, frozen)

    def _on_CXXOperatorCallExpr(self, node, children, scope, frozen):
        operator = operator_name(node)
        if operator and len(children) == 3:
            self._binary(node, operator, children[1], children[2], scope, frozen)
        elif operator and len(children) == 2:
            self._unary(node, operator, children[1], scope, frozen)

    def _binary(self, node, operator, left, right, scope, frozen):
        if NOT_ARITHMETIC.search(type_of(node)) or "span" not in left or "span" not in right:
            return
        others = BINARY.get(operator, ())
        if operator in INTEGER_ONLY and type_of(node) in ("int", "unsigned int", "bool"):
            others = INTEGER_ONLY[operator]
        if operator in ("&&", "||"):
            others = ("left", "right")
        if not others:
            return
        site = self._site(node, frozen)
        if site is None:
            return
        function = "::".join(scope)
        between = (left["span"].end, right["span"].begin)
        gap = site.source[between[0]:between[1]]
        if operator not in gap:
            return
        before, after = site.source[site.begin:between[0]], site.source[between[1]:site.end]
        for other in others:
            any_type = None
            if other in ("left", "right"):
                text = before if other == "left" else after
            else:
                text = before + gap.replace(operator, other, 1) + after
            if other == "/":
                any_type = f"eepa_mutant::divided({before}, {after})"
            site.add(function, f"{operator} -> {other}", text, any_type)

    def _on_UnaryOperator(self, node, children, scope, frozen):
        self._unary(node, node["opcode"], children[0], scope, frozen)

    def _unary(self, node, operator, operand, scope, frozen):
        if operator in ("-", "!") and "span" in operand:
            site = self._site(node, frozen)
            if site:
                site.add("::".join(scope), f"{operator} taken away", f"({self._text(operand)})")

    def _condition(self, node, scope, frozen, what):
        site = self._site(node, frozen)
        if site:
            for value in ("true", "false"):
                site.add("::".join(scope), f"{what} -> {value}", value)

    def _on_IfStmt(self, node, children, scope, frozen):
        condition = int(bool(node.get("hasInit")))
        if node.get("isConstexpr"):
            # the compiler chooses: what it has chosen can be left out, and no more
            body = children[condition + 1]
            site = self._site(body, False, "block") if body["kind"] == "CompoundStmt" else None
            if site:
                site.add("::".join(scope), "if constexpr dropped", "")
        elif not node.get("hasVar"):
            self._condition(children[condition], scope, frozen, "if")

    def _on_ConditionalOperator(self, node, children, scope, frozen):
        self._condition(children[0], scope, frozen, "?:")

    def _on_CallExpr(self, node, children, scope, frozen):
        name = callee(node)
        site = self._site(node, frozen) if name else None
        if site is None or any("span" not in c for c in children):
            return
        function, arguments = "::".join(scope), children[1:]
        texts = [self._text(a) for a in arguments]

        def with_arguments(new):
            """The call with other texts for its arguments; what stands between stays."""
            parts, at = [], site.begin
            for argument, text in zip(arguments, new):
                parts += [site.source[at:argument["span"].begin], text]
                at = argument["span"].end
            return "".join(parts) + site.source[at:site.end]

        if name == "select" and len(arguments) == 3:
            _, a, b = texts
            site.add(function, "select -> first", with_arguments([texts[0], a, a]))
            site.add(function, "select -> second", with_arguments([texts[0], b, b]))
            return
        if name in OTHER_CALL and len(arguments) == 2:
            start = children[0]["span"]
            function_text = site.source[start.begin:start.end]
            last = function_text.rindex(name)
            site.add(function, f"{name} -> {OTHER_CALL[name]}",
                     function_text[:last] + OTHER_CALL[name] +
                     function_text[last + len(name):] + site.source[start.end:site.end])
        if name in TAKEN_AWAY and len(arguments) == 1:
            site.add(function, f"{name} taken away", f"({texts[0]})")
        if name == "cross":
            site.add(function, "cross -> -cross", f"-({site.original()})")
        if name not in SYMMETRIC:
            for k in range(len(arguments) - 1):
                kinds = {bare(type_of(a)) for a in arguments[k:k + 2]}
                if len(kinds) == 1 and "dependent" not in (kind := kinds.pop()) and \
                        not re.search("string|char|lambda", kind) and texts[k] != texts[k + 1]:
                    swapped = texts[:k] + [texts[k + 1], texts[k]] + texts[k + 2:]
                    site.add(function, f"{name}(): arguments {k + 1} and {k + 2} swapped",
                             with_arguments(swapped))

    _on_CXXMemberCallExpr = _on_CallExpr

    def _constant(self, node, scope, frozen, texts):
        site = self._site(node, frozen, "constant")
        # a name is a macro, in which the literal stands
        if site and re.match(r"[\d.]|true$|false$", site.original()):
            for label, text in texts(site.original()):
                site.add("::".join(scope), f"{site.original()} {label}", text)

    def _on_FloatingLiteral(self, node, children, scope, frozen):
        self._constant(node, scope, frozen,
                       lambda c: [("-> 1.0", "1.0")] if float(c) == 0.0 else
                       [("-> 0.0", "0.0"), ("+ 1%", f"(1.01 * {c})")])

    def _on_IntegerLiteral(self, node, children, scope, frozen):
        self._constant(node, scope, frozen,
                       lambda c: [("-> 1", "1")] if int(c, 0) == 0 else
                       [(f"-> {int(c, 0) - 1}", f"({c} - 1)")])

    def _on_CXXBoolLiteralExpr(self, node, children, scope, frozen):
        self._constant(node, scope, frozen, lambda c: [
            ("-> false", "false") if c == "true" else ("-> true", "true")])


def name_all(sites):
    """Gives every mutant its key, unique as long as the files are given in the same order."""
    count = {}
    for site in sites:
        for mutant in site.mutants:
            key = f"{mutant.function}: {mutant.label}"
            count[key] = count.get(key, 0) + 1
            mutant.key = key if count[key] == 1 else f"{key} #{count[key]}"
